// The schema of scene files as JSON Schema, draft-07 (https://json-schema.org/draft-07). Where one key of a table
// determines which of the others apply, such as the shape of a body, each of its values gets an alternative with just
// the keys that apply to it.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/schema/schema.h"
#include "scenes/schema/schema_export.h"
#include "scenes/text/value.h"

namespace scenes {
namespace {

/// JSON whose members keep the order in which they are added, so that the file reads in the order of the schema.
using Json = nlohmann::ordered_json;

Json numberSchema(const char* type, const Range& range) {
    Json json = {{"type", type}};
    if (std::isfinite(range.low)) json[range.isLowExcluded ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) json[range.isHighExcluded ? "exclusiveMaximum" : "maximum"] = range.high;
    return json;
}

/// The JSON Schema of a list.
/// @param length  number of items; 0: one or more
Json arraySchema(Json items, int length) {
    Json json = {{"type", "array"}, {"items", std::move(items)}, {"minItems", std::max(1, length)}};
    if (length > 0) json["maxItems"] = length;
    return json;
}

Json colorSchema(const Range& range) {
    return {{"anyOf",
             {{{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}, arraySchema(numberSchema("number", range), 3)}}};
}

Json typeSchema(const Key& key) {
    switch (key.type) {
        case Type::number:
            return numberSchema("number", key.range);
        case Type::numberList:
            return arraySchema(numberSchema("number", key.range), 0);
        case Type::integer:
            return numberSchema("integer", key.range);
        case Type::frameRate:
            return {
                {"anyOf", {numberSchema("integer", key.range), {{"type", "string"}, {"pattern", "^[0-9]+/[0-9]+$"}}}}};
        case Type::boolean:
            return {{"type", "boolean"}};
        case Type::string:
            return {{"type", "string"}};
        case Type::stringList:
            return {{"type", "array"}, {"items", {{"type", "string"}}}};
        case Type::choice:
            return {{"type", "string"}, {"enum", key.choices}};
        case Type::vec3:
            return arraySchema(numberSchema("number", key.range), 3);
        case Type::vec3List:
            return arraySchema(arraySchema(numberSchema("number", key.range), 3), 0);
        case Type::color:
            return colorSchema(key.range);
        case Type::colorList:
            return arraySchema(colorSchema(key.range), 0);
        case Type::pairList:
            return arraySchema(arraySchema(numberSchema("number", key.range), 2), 0);
        case Type::interval:
            return arraySchema(numberSchema("number", key.range), 2);
        case Type::size:
            return arraySchema(numberSchema("integer", key.range), 2);
        case Type::counts:
            return arraySchema(numberSchema("integer", key.range), 3);
    }
    return {};
}

Json tableValueSchema(const TableInfo& table);

Json keySchema(const Key& key) {
    Json json = typeSchema(key);
    std::string description(key.help);
    if (!key.unit.empty()) description += " (" + std::string(key.unit) + ")";
    if (!key.derivedDefault.empty()) description += "; default: " + std::string(key.derivedDefault);
    json["description"] = description;
    // The TOML text of every default, a number, boolean, string or list, is JSON as well.
    if (!key.defaultValue.empty()) json["default"] = Json::parse(key.defaultValue);
    return json;
}

/// The JSON Schema of a table with the given keys, the tables within it, and nothing else.
Json objectSchema(std::string_view table, const std::vector<const Key*>& keys) {
    Json json = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    Json required = Json::array();
    for (const Key* key : keys) {
        json["properties"][std::string(key->name)] = keySchema(*key);
        if (key->isRequired) required.push_back(key->name);
    }
    if (!required.empty()) json["required"] = required;
    for (const TableInfo* within : tablesWithin(table))
        json["properties"][std::string(localNameOf(*within))] = tableValueSchema(*within);
    return json;
}

/// The JSON Schema of a table for one value of its discriminator, the key that determines which of the others apply.
Json variantSchema(const TableInfo& table, const Key& discriminator, std::string_view variant) {
    std::vector<const Key*> keys;
    for (const Key* key : keysOf(table.name))
        if (key->appliesTo.empty() || std::ranges::count(key->appliesTo, variant) > 0) keys.push_back(key);
    Json json = objectSchema(table.name, keys);
    Json& choice = json["properties"][std::string(discriminator.name)];
    choice.erase("enum");
    choice["const"] = variant;
    // If the discriminator has a default, it may be left out in the variant of that default only. A camera takes it
    // from the camera before, which a JSON Schema cannot follow, so that it may be left out in every variant.
    const bool isDefault = discriminator.defaultValue == tomlString(variant);
    if (!discriminator.isRequired && !isDefault && !table.inheritsPrevious)
        json["required"].push_back(discriminator.name);
    return json;
}

Json tableSchema(const TableInfo& table) {
    if (table.discriminator.empty()) return objectSchema(table.name, keysOf(table.name));
    const Key& discriminator = *findKey(table.name, table.discriminator);
    Json variants = Json::array();
    for (const std::string_view variant : discriminator.choices)
        variants.push_back(variantSchema(table, discriminator, variant));
    return {{"anyOf", variants}};
}

/// The JSON Schema of a table in every form in which it may be written: [name], [[name]] or both.
Json tableValueSchema(const TableInfo& table) {
    const Json reference = {{"$ref", "#/definitions/" + std::string(table.name)}};
    Json forms = Json::array();
    if (table.allowsSingle) forms.push_back(reference);
    if (table.allowsList) forms.push_back({{"type", "array"}, {"items", reference}});
    Json json = forms.size() == 1 ? forms[0] : Json{{"anyOf", forms}};
    // In draft-07 the members beside a "$ref" are ignored.
    if (json.contains("$ref")) json = {{"allOf", Json::array({json})}};
    json["description"] = table.help;
    return json;
}

}  // namespace

std::string jsonSchema() {
    Json json = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "globular scene"},
                 {"description", "A scene file of globular, a particle simulation of liquids, powders and solids"}};
    json.update(objectSchema("", keysOf("")));
    Json definitions = Json::object();
    for (const TableInfo& table : tables()) {
        if (table.name.empty()) continue;
        if (isTableName(table.name)) json["properties"][std::string(table.name)] = tableValueSchema(table);
        definitions[std::string(table.name)] = tableSchema(table);
    }
    json["definitions"] = definitions;
    return json.dump(2) + '\n';
}

}  // namespace scenes
