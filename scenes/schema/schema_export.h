// The schema in the forms that `globular schema` prints: columns of text, text for a terminal, Markdown for
// docs/scenes.md, and JSON Schema for editors.
#pragma once

#include <string>
#include <vector>

namespace scenes {

/// A key of a scene file as columns of text, for lists of all keys.
struct SchemaRow {
    std::string key;
    std::string type;
    std::string unit;
    std::string defaultText;  ///< the default as TOML, or in words in parentheses, or "required"
    std::string range;        ///< bounds of a number, or choices
    std::string appliesTo;    ///< when the key applies, e.g. "shape ball, grid"; empty: always
    std::string help;
};

std::vector<SchemaRow> schemaRows();

/// All keys of scene files, and the presets of materials, as text for a terminal.
std::string schemaText();

/// The whole schema as Markdown: for each table of a scene file a section with a table of its keys; for materials also
/// the presets, and what the constants do.
std::string schemaMarkdown();

/// The whole schema as JSON Schema, draft-07, which taplo and Even Better TOML read. It accepts every valid scene.
/// Rules about several keys, such as "either position or positions", are not part of it.
std::string jsonSchema();

}  // namespace scenes
