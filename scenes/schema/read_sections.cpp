// Tables of a scene file, found by name. What is inside a table is read_table.cpp's business.
#include "scenes/schema/read_sections.h"

#include <fmt/format.h>

#include "scenes/schema/read_table.h"
#include "scenes/text/edit_distance.h"

namespace scenes {
namespace {

struct Reader {
    const Document& document;
    ProblemList& problems;
    bool doubtful = false;
};

Section readOne(const Reader& reader, const TableInfo& info, std::string prefix, const Value& value,
                const Section* before = nullptr) {
    return readTable({info, std::move(prefix), value, reader.document.damaged, before}, reader.problems);
}

Section absent(const Reader& reader, const TableInfo& info) {
    return readOne(reader, info, std::string(info.name), Value{});
}

/// A table that is written once. If it is written as a list its first item is read all the same, to find what is wrong
/// there.
Section readSingle(Reader& reader, const char* name) {
    const TableInfo& info = *findTable(name);
    const Entry* entry = findEntry(reader.document.root, name);
    if (entry == nullptr) return absent(reader, info);
    if (entry->value.kind == Kind::table) return readOne(reader, info, name, entry->value);
    reader.doubtful = true;
    if (entry->value.kind == Kind::broken) return absent(reader, info);
    reader.problems.add(entry->value.at,
                        fmt::format("{} is {}, must be one table: [{}]", name, describe(entry->value), name));
    const bool hasTable =
        entry->value.kind == Kind::array && !entry->value.items.empty() && entry->value.items[0].kind == Kind::table;
    return hasTable ? readOne(reader, info, name, entry->value.items[0]) : absent(reader, info);
}

/// A table that a scene may do without.
std::optional<Section> readOptional(Reader& reader, const char* name) {
    if (findEntry(reader.document.root, name) == nullptr) return std::nullopt;
    return readSingle(reader, name);
}

void readItems(Reader& reader, const TableInfo& info, const Value& list, std::vector<Section>& sections) {
    for (std::size_t index = 0; index < list.items.size(); ++index) {
        const Value& item = list.items[index];
        std::string prefix = fmt::format("{}[{}]", info.name, index);
        if (item.kind == Kind::table) {
            const Section* before = info.inherits && !sections.empty() ? &sections.back() : nullptr;
            sections.push_back(readOne(reader, info, std::move(prefix), item, before));
        } else {
            reader.doubtful = true;
            reader.problems.add(item.at, fmt::format("{} is {}, must be a table", prefix, describe(item)));
        }
    }
}

std::vector<Section> readList(Reader& reader, const char* name) {
    const TableInfo& info = *findTable(name);
    std::vector<Section> sections;
    const Entry* entry = findEntry(reader.document.root, name);
    if (entry == nullptr) return sections;
    const Value& value = entry->value;
    if (value.kind == Kind::array) {
        readItems(reader, info, value, sections);
        return sections;
    }
    if (value.kind != Kind::table || !info.single) {
        reader.doubtful = true;
        if (value.kind != Kind::broken)
            reader.problems.add(value.at,
                                fmt::format("{} is {}, must be a list of tables: [[{}]]", name, describe(value), name));
    }
    if (value.kind == Kind::table) sections.push_back(readOne(reader, info, name, value));
    return sections;
}

void reportUnknownTables(Reader& reader) {
    std::vector<std::string> names;
    for (const TableInfo& table : tables()) names.emplace_back(table.name);
    for (const Entry& entry : reader.document.root.entries) {
        const bool isTable =
            entry.value.kind == Kind::table ||
            (entry.value.kind == Kind::array && !entry.value.items.empty() && entry.value.items[0].kind == Kind::table);
        if (!isTable || isSection(entry.key) || findKey("", entry.key) != nullptr) continue;
        reader.doubtful = true;
        const std::string nearest = nearestName(entry.key, names);
        // The header itself, not the name in it, is where a table begins.
        reader.problems.add(entry.value.at,
                            fmt::format("unknown table {}{}", inQuotes(entry.key),
                                        nearest.empty() ? "" : fmt::format(", did you mean {}?", inQuotes(nearest))));
    }
}

}  // namespace

std::vector<const Section*> Sections::all() const {
    std::vector<const Section*> list = {&top, &physics, &world};
    for (const std::vector<Section>* group : {&materials, &bodies, &emitters, &obstacles, &cameras})
        for (const Section& section : *group) list.push_back(&section);
    for (const Section* section : {&look, &overlay, &still}) list.push_back(section);
    if (study) list.push_back(&*study);
    return list;
}

Sections readSections(const Document& document, ProblemList& problems) {
    Reader reader{document, problems, document.damaged};
    reportUnknownTables(reader);
    Sections sections{
        .top = readOne(reader, *findTable(""), "", document.root),
        .physics = readSingle(reader, "physics"),
        .world = readSingle(reader, "world"),
        .look = readSingle(reader, "look"),
        .overlay = readSingle(reader, "overlay"),
        .still = readSingle(reader, "still"),
        .materials = readList(reader, "material"),
        .bodies = readList(reader, "body"),
        .emitters = readList(reader, "emitter"),
        .obstacles = readList(reader, "obstacle"),
        .cameras = readList(reader, "camera"),
        .study = readOptional(reader, "study"),
    };
    // Without a [material] everything is made of the first preset.
    if (sections.materials.empty()) sections.materials.push_back(absent(reader, *findTable("material")));
    if (sections.cameras.empty()) sections.cameras.push_back(absent(reader, *findTable("camera")));
    sections.doubtful = reader.doubtful;
    return sections;
}

}  // namespace scenes
