// Writes all keys of scene files as columns of text, as text for a terminal, and as Markdown.
#include "scenes/schema/schema_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scenes/schema/material_guide.h"
#include "scenes/schema/schema.h"

namespace scenes {
namespace {

std::string joined(const std::vector<std::string_view>& words, std::string_view separator) {
    return fmt::format("{}", fmt::join(words, separator));
}

std::string defaultText(const Key& key) {
    if (key.isRequired) return "required";
    if (!key.defaultValue.empty()) return std::string(key.defaultValue);
    return fmt::format("({})", key.derivedDefault);
}

SchemaRow rowOf(const Key& key) {
    SchemaRow row;
    row.key = pathOf(key);
    row.type = typeText(key.type);
    row.unit = std::string(key.unit);
    row.defaultText = defaultText(key);
    row.range = key.type == Type::choice ? joined(key.choices, " | ") : rangeText(key.range);
    if (!key.appliesTo.empty())
        row.appliesTo = fmt::format("{} {}", findTable(key.table)->discriminator, joined(key.appliesTo, ", "));
    row.help = std::string(key.help);
    return row;
}

/// Type, unit, range, default and condition of a key in one line: "number, m, > 0, default 0.15".
std::string factsOf(const SchemaRow& row) {
    std::string facts = row.type;
    if (!row.unit.empty()) facts += fmt::format(", {}", row.unit);
    if (!row.range.empty()) facts += fmt::format(", {}", row.range);
    facts += fmt::format(", {}{}", row.defaultText == "required" ? "" : "default ", row.defaultText);
    if (!row.appliesTo.empty()) facts += fmt::format("; {}", row.appliesTo);
    return facts;
}

/// A table's header as it is written in a scene file; empty for the keys above the first table.
std::string headerOf(const TableInfo& table) {
    if (table.name.empty()) return {};
    return fmt::format(fmt::runtime(table.allowsSingle ? "[{}]" : "[[{}]]"), table.name);
}

/// Text for a cell of a Markdown table, where | separates columns and < may open a tag.
std::string inCell(std::string_view text) {
    std::string cell;
    for (const char c : text) {
        if (c == '|' || c == '<') cell += '\\';
        cell += c;
    }
    return cell;
}

/// Text for a cell of a Markdown table as code; empty text stays empty.
std::string codeInCell(std::string_view text) {
    return text.empty() ? "" : fmt::format("`{}`", text);
}

std::string markdownRow(const Key& key) {
    const SchemaRow row = rowOf(key);
    const std::string type = row.unit.empty() ? row.type : fmt::format("{}, {}", row.type, row.unit);
    const std::string defaultCell = key.defaultValue.empty() ? row.defaultText : codeInCell(row.defaultText);
    std::vector<std::string> choices;
    for (const std::string_view choice : key.choices) choices.push_back(codeInCell(choice));
    const std::string range = choices.empty() ? inCell(row.range) : fmt::format("{}", fmt::join(choices, ", "));
    const std::string condition = row.appliesTo.empty() ? "" : fmt::format(" (only for {})", row.appliesTo);
    return fmt::format("| `{}` | {} | {} | {} | {}{} |\n", key.name, type, defaultCell, range, inCell(row.help),
                       condition);
}

/// Pictures of all shapes, for the page. `tools/gallery.sh shapes` draws them.
constexpr std::string_view kBodyPictures = R"(
![The particles of a body of each shape](bodies.webp)

The shapes of bodies, drawn in [bodies.toml](bodies.toml) by `tools/gallery.sh shapes`.
)";
constexpr std::string_view kObstaclePictures = R"(
![Honey runs over an obstacle of each shape](shapes.webp)

The shapes of obstacles, in [shapes.toml](shapes.toml).
)";

}  // namespace

std::vector<SchemaRow> schemaRows() {
    std::vector<SchemaRow> rows;
    for (const Key& key : schema()) rows.push_back(rowOf(key));
    return rows;
}

std::string schemaText() {
    std::size_t width = 0;
    for (const Key& key : schema()) width = std::max(width, key.name.size());
    std::string text;
    for (const TableInfo& table : tables()) {
        const std::string header = headerOf(table);
        text += header.empty() ? fmt::format("# {}\n", table.help) : fmt::format("\n{}  # {}\n", header, table.help);
        for (const Key* key : keysOf(table.name)) {
            text += fmt::format("  {:<{}}  {}\n", key->name, width, key->help);
            text += fmt::format("  {:<{}}    {}\n", "", width, factsOf(rowOf(*key)));
        }
    }
    return text + "\n" + presetsText();
}

std::string schemaMarkdown() {
    std::string text = R"(# Scene files

A scene is a [TOML](https://toml.io) file. This page lists every key that it may contain, the [presets](#presets) of materials and
[what the constants of a material do](#what-the-constants-do). It is generated: run `globular schema --markdown > docs/scenes.md`
after a change of the schema. `globular schema` shows the keys and presets in a terminal.

Editors can complete and check keys: `globular schema --json-schema > globular.schema.json` writes a JSON Schema, which
taplo and Even Better TOML use for a scene that starts with the line `#:schema ./globular.schema.json`.

Lengths are in meters, masses in kilograms, times in seconds; y points up. A color is `"#rrggbb"` in sRGB, or `[r, g, b]`
in linear light from 0 to 1. A default in parentheses depends on other keys. Any key can be changed on the command line,
for example with `--set physics.step=0.001` or `--set body[0].radius=0.5`. Unknown keys, wrong types and values out of
range are errors, and are reported with line and column.
)";
    for (const TableInfo& table : tables()) {
        const std::string header = headerOf(table);
        text += fmt::format("\n## {}\n\n", header.empty() ? "Keys above the first table" : fmt::format("`{}`", header));
        if (!header.empty())
            text += fmt::format("{}{}.\n\n", static_cast<char>(std::toupper(table.help[0])), table.help.substr(1));
        text += "| Key | Type, unit | Default | Range or choices | Meaning |\n|---|---|---|---|---|\n";
        for (const Key* key : keysOf(table.name)) text += markdownRow(*key);
        if (table.name == "material") text += materialGuideMarkdown();
        if (table.name == "body") text += kBodyPictures;
        if (table.name == "obstacle") text += kObstaclePictures;
    }
    return text;
}

}  // namespace scenes
