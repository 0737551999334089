// The schema as columns of text, and as text for a terminal.
#include "scenes/schema/schema_export.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/schema/schema.h"

namespace scenes {
namespace {

std::string typeText(Type type) {
    switch (type) {
        case Type::number:
            return "number";
        case Type::numberList:
            return "list of numbers";
        case Type::integer:
            return "integer";
        case Type::boolean:
            return "boolean";
        case Type::string:
            return "string";
        case Type::stringList:
            return "list of strings";
        case Type::choice:
            return "choice";
        case Type::vec3:
            return "[x, y, z]";
        case Type::vec3List:
            return "list of [x, y, z]";
        case Type::color:
            return "color";
        case Type::colorList:
            return "list of colors";
        case Type::interval:
            return "[low, high]";
        case Type::size:
            return "[width, height]";
        case Type::counts:
            return "[nx, ny, nz]";
    }
    return {};
}

std::string joined(const std::vector<std::string_view>& words, std::string_view separator) {
    return fmt::format("{}", fmt::join(words, separator));
}

std::string defaultText(const Key& key) {
    if (key.isRequired) return "required";
    if (!key.defaultValue.empty()) return std::string(key.defaultValue);
    return key.derivedDefault.empty() ? "none" : fmt::format("({})", key.derivedDefault);
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

/// All columns but the key and the help, e.g. "number, m, > 0, default 0.15".
std::string factsOf(const SchemaRow& row) {
    std::string facts = row.type;
    if (!row.unit.empty()) facts += fmt::format(", {}", row.unit);
    if (!row.range.empty()) facts += fmt::format(", {}", row.range);
    facts += row.defaultText == "required" || row.defaultText == "none"
                 ? fmt::format(", {}", row.defaultText == "none" ? "no default" : "required")
                 : fmt::format(", default {}", row.defaultText);
    if (!row.appliesTo.empty()) facts += fmt::format("; {}", row.appliesTo);
    return facts;
}

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
        const std::string_view brackets = table.name.empty()   ? "{}# {}\n"
                                          : table.allowsSingle ? "\n[{}]  # {}\n"
                                                               : "\n[[{}]]  # {}\n";
        text += fmt::format(fmt::runtime(brackets), table.name, table.help);
        for (const Key* key : keysOf(table.name)) {
            text += fmt::format("  {:<{}}  {}\n", key->name, width, key->help);
            text += fmt::format("  {:<{}}    {}\n", "", width, factsOf(rowOf(*key)));
        }
    }
    return text;
}

}  // namespace scenes
