// The schema in the forms that `globular schema` prints.
#pragma once

#include <string>
#include <vector>

namespace scenes {

/// A key as columns of text.
struct SchemaRow {
    std::string key;
    std::string type;
    std::string unit;
    std::string defaultText;  ///< as TOML, or in words in parentheses; otherwise "required" or "none"
    std::string range;        ///< bounds or choices
    std::string appliesTo;    ///< e.g. "shape ball, grid"; empty: always
    std::string help;
};

std::vector<SchemaRow> schemaRows();

/// The whole schema as text for a terminal.
std::string schemaText();

}  // namespace scenes
