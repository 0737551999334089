// Finds the tables of a scene by name, and reads each in three passes: the keys that are written, then defaults, then
// what is missing.
#include "scenes/schema/read_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scenes/text/edit_distance.h"

namespace scenes {
namespace {

/// The constant default of a key; nullptr if it has none. Defaults are validated like any value, and a default outside
/// the range of its key is a bug, which throws.
const TypedValue* defaultOf(const Key& key) {
    static const std::map<const Key*, TypedValue> kDefaults = [] {
        std::map<const Key*, TypedValue> defaults;
        ProblemList problems("schema", {});
        for (const Key& row : schema()) {
            if (row.defaultValue.empty()) continue;
            if (auto typed = validateValue(row, parseOverrideValue(std::string(row.defaultValue), -1), problems))
                defaults.emplace(&row, std::move(*typed));
        }
        problems.throwIfAny();
        return defaults;
    }();
    const auto found = kDefaults.find(&key);
    return found == kDefaults.end() ? nullptr : &found->second;
}

/// A table of a scene file while it is read.
struct TableReader {
    const TableInfo& info;
    const Value& value;  ///< the table as it is written; empty if the scene does not have it
    bool hasOmissions;   ///< a part of the file could not be read: missing keys are not reported
    ProblemList& problems;
    const Section* previous;  ///< the table before in the list, if this one inherits from it
    Section section;
    std::string variant = {};  ///< value of the key that determines which others apply; empty if unknown
    SourcePosition variantPosition = {};
};

std::string fullName(const TableInfo& info, std::string_view key) {
    return info.name.empty() ? std::string(key) : fmt::format("{}.{}", info.name, key);
}

/// Whether a value of a TOML file is a table or a list of tables.
bool isTableOrList(const Value& value) {
    return value.kind == ValueKind::table ||
           (value.kind == ValueKind::array && !value.items.empty() && value.items[0].kind == ValueKind::table);
}

/// The path of the first key of this name in the tables within a table, or else in any table of the schema, such as
/// "physics.step"; empty if there is none.
std::string pathInAnyTable(const TableInfo& info, std::string_view name) {
    for (const TableInfo* within : tablesWithin(info.name))
        if (const Key* key = findKey(within->name, name)) return pathOf(*key);
    for (const Key& key : schema())
        if (key.name == name && parentOf(*findTable(key.table)).empty()) return pathOf(key);
    return {};
}

void reportUnknownTable(TableReader& reader, const Entry& entry) {
    std::vector<std::string> names;
    for (const TableInfo* within : tablesWithin(reader.info.name)) names.emplace_back(localNameOf(*within));
    const std::string nearest = nearestName(entry.key, names);
    const std::string hint =
        nearest.empty() ? "" : fmt::format(", did you mean {}?", tomlString(fullName(reader.info, nearest)));
    reader.problems.add(entry.value.position,
                        fmt::format("unknown table {}{}", tomlString(fullName(reader.info, entry.key)), hint));
    reader.section.markInvalid();
}

void reportUnknown(TableReader& reader, const Entry& entry) {
    const TableInfo& info = reader.info;
    if (isTableOrList(entry.value) && !tablesWithin(info.name).empty()) return reportUnknownTable(reader, entry);
    std::vector<std::string> names;
    for (const Key* key : keysOf(info.name)) names.emplace_back(key->name);
    std::string hint = nearestName(entry.key, names);
    if (!hint.empty()) {
        // The suggested key is probably what was meant, so it counts as written and is not reported as missing, too.
        reader.section.putInvalid(hint, entry.position);
        hint = fmt::format(", did you mean {}?", tomlString(hint));
    } else if (const std::string path = pathInAnyTable(info, entry.key); !path.empty()) {
        hint = path == entry.key ? ": it belongs above the first table"
                                 : fmt::format(", did you mean {}?", tomlString(path));
    }
    reader.problems.add(entry.position, fmt::format("unknown key {}{}", tomlString(fullName(info, entry.key)), hint));
    reader.section.markInvalid();
}

/// The value that a table takes for a key from the table before in its list, as the cameras of a path do; nullptr if it
/// takes none.
const TypedValue* inheritedBy(const TableReader& reader, const Key& key) {
    const Section* previous = reader.previous;
    const std::string_view name = key.name;
    return previous != nullptr && key.isInherited && previous->has(name) ? &previous->typed(name) : nullptr;
}

bool applies(const TableReader& reader, const Key& key) {
    return key.appliesTo.empty() ||
           std::find(key.appliesTo.begin(), key.appliesTo.end(), reader.variant) != key.appliesTo.end();
}

void reportInapplicable(TableReader& reader, const Entry& entry, const Key& key) {
    // Where an override of the command line changes the shape, the keys that the file gives for the former shape are
    // ignored.
    if (reader.variantPosition.overrideIndex >= 0 && entry.position.overrideIndex < 0) return;
    reader.problems.add(entry.position,
                        fmt::format("{} does not apply to {} {}, only to {}", entry.key, reader.info.discriminator,
                                    tomlString(reader.variant), fmt::join(key.appliesTo, ", ")));
    reader.section.markInvalid();
}

void readEntry(TableReader& reader, const Entry& entry) {
    const Key* key = findKey(reader.info.name, entry.key);
    if (key == nullptr) return reportUnknown(reader, entry);
    if (!reader.variant.empty() && !applies(reader, *key)) return reportInapplicable(reader, entry, *key);
    if (auto typed = validateValue(*key, entry.value, reader.problems))
        reader.section.put(entry.key, std::move(*typed), entry.value.position, ValueOrigin::given);
    else
        reader.section.putInvalid(entry.key, entry.value.position);
}

/// Finds the value of a table's discriminator, the key that determines which others apply. Problems with that key
/// itself are reported by readEntry.
void findVariant(TableReader& reader) {
    const std::string_view name = reader.info.discriminator;
    if (name.empty()) return;
    const Key& key = *findKey(reader.info.name, name);
    ProblemList ignored("", {});
    if (const Entry* entry = findEntry(reader.value, name)) {
        reader.variantPosition = entry->position;
        if (const auto typed = validateValue(key, entry->value, ignored)) reader.variant = typed->string;
    } else if (const TypedValue* inherited = inheritedBy(reader, key)) {
        reader.variant = inherited->string;
    } else if (const TypedValue* constant = defaultOf(key)) {
        reader.variant = constant->string;
    }
}

void reportMissing(TableReader& reader, const Key& key) {
    reader.section.markInvalid();
    if (!reader.hasOmissions) reader.problems.add(reader.section.position(), missingText(reader.section, key));
}

void completeKey(TableReader& reader, const Key& key) {
    const std::string_view name = key.name;
    if (reader.section.has(name) || !applies(reader, key)) return;
    if (const TypedValue* inherited = inheritedBy(reader, key))
        reader.section.put(name, *inherited, reader.section.position(), ValueOrigin::derived);
    else if (const TypedValue* constant = defaultOf(key))
        reader.section.put(name, *constant, reader.section.position(), ValueOrigin::schemaDefault);
    else if (key.isRequired && !reader.section.isGiven(name))
        reportMissing(reader, key);
}

/// All tables of a scene file while they are read.
struct SectionsReader {
    const Document& document;
    ProblemList& problems;
    bool mayBeIncomplete = false;
};

std::vector<Section> readList(SectionsReader& reader, const TableInfo& info, const std::string& path,
                              const Entry* entry);

/// Validates a table and those within it, and completes it with inherited values and the schema's defaults.
Section readOne(SectionsReader& all, const TableInfo& info, std::string path, const Value& value,
                const Section* previous = nullptr) {
    TableReader reader{.info = info,
                       .value = value,
                       .hasOmissions = all.document.hasOmissions,
                       .problems = all.problems,
                       .previous = previous,
                       .section = Section(info, std::move(path), value.position)};
    findVariant(reader);
    const std::vector<const TableInfo*> tablesInside = tablesWithin(info.name);
    for (const Entry& entry : value.entries) {
        // The root of a TOML file has the keys above the first table and all tables. Only the keys are read here.
        const bool isTop = info.name.empty();
        const bool isTable = isTableOrList(entry.value);
        if (isTop && (isTableName(entry.key) || (isTable && findKey("", entry.key) == nullptr))) continue;
        const auto inside = std::ranges::find(tablesInside, std::string_view(entry.key),
                                              [](const TableInfo* within) { return localNameOf(*within); });
        if (inside == tablesInside.end())
            readEntry(reader, entry);
        else
            reader.section.list(entry.key) =
                readList(all, **inside, fmt::format("{}.{}", reader.section.path(), entry.key), &entry);
    }
    for (const Key* key : keysOf(info.name)) completeKey(reader, *key);
    return std::move(reader.section);
}

/// A table that is not in the scene file: every key has its default.
Section defaultSection(SectionsReader& reader, const TableInfo& info) {
    return readOne(reader, info, std::string(info.name), Value{});
}

/// A table that may be written once. If it is written as a list, its first item is read nevertheless, in order to
/// report the problems in it.
Section readSingle(SectionsReader& reader, const char* name) {
    const TableInfo& info = *findTable(name);
    const Entry* entry = findEntry(reader.document.root, name);
    if (entry == nullptr) return defaultSection(reader, info);
    if (entry->value.kind == ValueKind::table) return readOne(reader, info, name, entry->value);
    reader.mayBeIncomplete = true;
    if (entry->value.kind == ValueKind::invalid) return defaultSection(reader, info);
    reader.problems.add(entry->value.position,
                        fmt::format("{} is {}, must be one table: [{}]", name, describe(entry->value), name));
    return isTableOrList(entry->value) ? readOne(reader, info, name, entry->value.items[0])
                                       : defaultSection(reader, info);
}

/// Checks that the key of a list whose values have to increase does, from one table to the next.
void checkIncreasing(const Section& previous, Section& section, ProblemList& problems) {
    const std::string_view name = section.table().increasing;
    if (name.empty() || !previous.has(name) || !section.has(name)) return;
    if (section.number(name) > previous.number(name)) return;
    const Key& key = *findKey(section.table().name, name);
    section.markInvalid();
    problems.add(section.position(name),
                 fmt::format("{} is {}, must be after that of the {} before, {} ({})", name, section.canonical(name),
                             localNameOf(section.table()), previous.canonical(name), unitWords(key.unit)));
}

void readItems(SectionsReader& reader, const TableInfo& info, const std::string& listPath, const Value& list,
               std::vector<Section>& sections) {
    for (std::size_t index = 0; index < list.items.size(); ++index) {
        const Value& item = list.items[index];
        std::string path = fmt::format("{}[{}]", listPath, index);
        if (item.kind == ValueKind::table) {
            const Section* previous = info.inheritsPrevious && !sections.empty() ? &sections.back() : nullptr;
            sections.push_back(readOne(reader, info, std::move(path), item, previous));
            if (sections.size() > 1) checkIncreasing(sections[sections.size() - 2], sections.back(), reader.problems);
        } else {
            reader.mayBeIncomplete = true;
            reader.problems.add(item.position, fmt::format("{} is {}, must be a table", path, describe(item)));
        }
    }
}

/// A table that may be written several times.
/// @param path   of the list, e.g. "obstacle[0].key"
/// @param entry  the list, or a single table; nullptr if it was not written
std::vector<Section> readList(SectionsReader& reader, const TableInfo& info, const std::string& path,
                              const Entry* entry) {
    std::vector<Section> sections;
    if (entry == nullptr) return sections;
    const Value& value = entry->value;
    if (value.kind == ValueKind::array) {
        readItems(reader, info, path, value, sections);
        return sections;
    }
    if (value.kind != ValueKind::table || !info.allowsSingle) {
        reader.mayBeIncomplete = true;
        if (value.kind != ValueKind::invalid)
            reader.problems.add(value.position, fmt::format("{} is {}, must be a list of tables: [[{}]]", info.name,
                                                            describe(value), info.name));
    }
    if (value.kind == ValueKind::table) sections.push_back(readOne(reader, info, path, value));
    return sections;
}

std::vector<Section> readList(SectionsReader& reader, const char* name) {
    return readList(reader, *findTable(name), name, findEntry(reader.document.root, name));
}

void reportUnknownTables(SectionsReader& reader) {
    std::vector<std::string> names;
    for (const TableInfo& table : tables()) names.emplace_back(table.name);
    for (const Entry& entry : reader.document.root.entries) {
        const bool isTable = isTableOrList(entry.value);
        if (!isTable || isTableName(entry.key) || findKey("", entry.key) != nullptr) continue;
        reader.mayBeIncomplete = true;
        const std::string nearest = nearestName(entry.key, names);
        // The position of a table's value is that of the table's header.
        reader.problems.add(entry.value.position,
                            fmt::format("unknown table {}{}", tomlString(entry.key),
                                        nearest.empty() ? "" : fmt::format(", did you mean {}?", tomlString(nearest))));
    }
}

}  // namespace

std::string missingText(const Section& section, const Key& key) {
    const TableInfo& info = section.table();
    std::string subject(info.subject);
    if (!key.appliesTo.empty())
        subject += fmt::format(" of {} {}", info.discriminator, section.canonical(info.discriminator));
    const std::string unit = key.unit.empty() ? "" : fmt::format(" ({})", unitWords(key.unit));
    return fmt::format("{} is missing, {} needs it{}", key.name, subject, unit);
}

std::vector<const Section*> Sections::all() const {
    std::vector<const Section*> list = {&top, &physics, &world, &air};
    const auto add = [&](const Section& section) { list.push_back(&section); };
    for (const std::vector<Section>* sections : {&materials, &bodies, &emitters, &obstacles, &fields, &cameras})
        for (const Section& section : *sections) section.visitAll(add);
    for (const Section* section : {&look, &overlay, &still}) list.push_back(section);
    if (study) list.push_back(&*study);
    return list;
}

Sections readSections(const Document& document, ProblemList& problems) {
    SectionsReader reader{document, problems, document.hasOmissions};
    reportUnknownTables(reader);
    Sections sections{
        .top = readOne(reader, *findTable(""), "", document.root),
        .physics = readSingle(reader, "physics"),
        .world = readSingle(reader, "world"),
        .air = readSingle(reader, "air"),
        .look = readSingle(reader, "look"),
        .overlay = readSingle(reader, "overlay"),
        .still = readSingle(reader, "still"),
        .materials = readList(reader, "material"),
        .bodies = readList(reader, "body"),
        .emitters = readList(reader, "emitter"),
        .obstacles = readList(reader, "obstacle"),
        .fields = readList(reader, "field"),
        .cameras = readList(reader, "camera"),
        .study = {},
    };
    if (findEntry(document.root, "study") != nullptr) sections.study = readSingle(reader, "study");
    // A scene without a [material] uses the default preset.
    if (sections.materials.empty()) sections.materials.push_back(defaultSection(reader, *findTable("material")));
    if (sections.cameras.empty()) sections.cameras.push_back(defaultSection(reader, *findTable("camera")));
    sections.mayBeIncomplete = reader.mayBeIncomplete;
    return sections;
}

}  // namespace scenes
