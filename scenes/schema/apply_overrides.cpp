// Applies overrides, such as body[0].radius=0.5: splits the key into table, index and name, finds the table in the
// scene, and stores the value there.
#include "scenes/schema/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenes/schema/schema.h"

namespace scenes {
namespace {

/// The parts of a key such as "body[0].radius"; the table is empty for a key above the first table.
struct OverrideKey {
    std::string table;
    std::optional<std::size_t> index;
    std::string name;
};

std::optional<std::size_t> wholeNumber(const std::string& text) {
    // Numbers of more than six digits could overflow, and no scene has a million tables.
    if (text.empty() || text.size() > 6 || text.find_first_not_of("0123456789") != std::string::npos)
        return std::nullopt;
    return static_cast<std::size_t>(std::stoul(text));
}

/// The parts of the key of an override between dots, where body[0] counts as body.0; none if brackets are misplaced.
std::vector<std::string> partsOf(const std::string& path) {
    std::vector<std::string> parts(1);
    for (std::size_t at = 0; at < path.size(); ++at) {
        if (path[at] == '.' || path[at] == '[')
            parts.emplace_back();
        else if (path[at] == ']' && (at + 1 == path.size() || path[at + 1] != '.'))
            return {};
        else if (path[at] != ']')
            parts.back() += path[at];
    }
    return parts;
}

std::optional<OverrideKey> parseKey(const std::string& path) {
    const std::vector<std::string> parts = partsOf(path);
    for (const std::string& part : parts)
        if (part.empty()) return std::nullopt;
    if (parts.size() == 1) return OverrideKey{"", std::nullopt, parts[0]};
    if (parts.size() == 2 && !wholeNumber(parts[1])) return OverrideKey{parts[0], std::nullopt, parts[1]};
    if (parts.size() == 3 && wholeNumber(parts[1])) return OverrideKey{parts[0], wholeNumber(parts[1]), parts[2]};
    return std::nullopt;
}

Entry& findOrAdd(Value& table, const std::string& key, const SourcePosition& position) {
    const auto found = std::ranges::find(table.entries, key, &Entry::key);
    if (found != table.entries.end()) return *found;
    Entry entry;
    entry.key = key;
    entry.position = entry.value.position = position;
    table.entries.push_back(std::move(entry));
    return table.entries.back();
}

/// An override whose key has been parsed.
struct Assignment {
    OverrideKey key;
    std::string value;
    SourcePosition position;
};

/// The table of the scene that an override writes to; nullptr, with the problem recorded, if there is no such table.
Value* tableOf(Value& root, const Assignment& assignment, ProblemList& problems) {
    const OverrideKey& key = assignment.key;
    if (key.table.empty()) return &root;
    const TableInfo* info = findTable(key.table);
    const bool isListOnly = info != nullptr && info->allowsList && !info->allowsSingle;
    const Entry* existing = findEntry(root, key.table);
    if (existing == nullptr && !isListOnly && key.index.value_or(0) == 0)
        return &findOrAdd(root, key.table, assignment.position).value;
    const bool isArray = existing != nullptr && existing->value.kind == ValueKind::array;
    const std::size_t count = isArray ? existing->value.items.size() : existing != nullptr ? 1 : 0;
    if (key.index.value_or(0) >= count) {
        problems.add(assignment.position,
                     count == 0 ? fmt::format("the scene has no [[{}]]", key.table)
                                : fmt::format("the scene has only {} [[{}]], counted from 0", count, key.table));
        return nullptr;
    }
    Value& value = findOrAdd(root, key.table, assignment.position).value;
    if (!isArray) return &value;
    if (key.index) return &value.items[*key.index];
    problems.add(assignment.position, fmt::format("{} is a list, write {}[0].{}", key.table, key.table, key.name));
    return nullptr;
}

void apply(Value& root, const Assignment& assignment, ProblemList& problems) {
    Value* table = tableOf(root, assignment, problems);
    if (table == nullptr) return;
    const OverrideKey& key = assignment.key;
    if (table->kind != ValueKind::table) {
        // Where the schema expects a table, the later validation reports what the scene has instead.
        if (findTable(key.table) == nullptr)
            problems.add(assignment.position,
                         fmt::format("{} is not a table, {} has no key {}", key.table, key.table, key.name));
        return;
    }
    Entry& entry = findOrAdd(*table, key.name, assignment.position);
    entry.position = assignment.position;
    entry.value = parseOverrideValue(assignment.value, assignment.position.overrideIndex);
}

}  // namespace

void applyOverrides(Value& root, const Overrides& overrides, ProblemList& problems) {
    for (std::size_t index = 0; index < overrides.size(); ++index) {
        const SourcePosition position{.overrideIndex = static_cast<int>(index)};
        const std::string& text = overrides[index].assignment;
        const std::size_t equals = text.find('=');
        const auto key = equals == std::string::npos ? std::nullopt : parseKey(text.substr(0, equals));
        if (key)
            apply(root, {*key, text.substr(equals + 1), position}, problems);
        else
            problems.add(position, "must be KEY=VALUE, with a key like fps, physics.step or body[0].radius");
    }
}

}  // namespace scenes
