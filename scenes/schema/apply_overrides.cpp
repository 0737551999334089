// Applies overrides, such as body[0].radius=0.5: splits the key into table, index and name, finds the table in the
// scene, and stores the value there.
#include "scenes/schema/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenes/schema/schema.h"

namespace scenes {
namespace {

/// An override such as "body[0].radius=0.5".
struct Assignment {
    SourcePosition position;
    std::string value;
    std::string table;  ///< name of the table; empty for a key above the first table
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

std::optional<Assignment> parseAssignment(const std::string& text, const SourcePosition& position) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return std::nullopt;
    const std::string value = text.substr(equals + 1);
    const std::vector<std::string> parts = partsOf(text.substr(0, equals));
    if (std::ranges::any_of(parts, [](const std::string& part) { return part.empty(); })) return std::nullopt;
    if (parts.size() == 1) return Assignment{position, value, "", std::nullopt, parts[0]};
    if (parts.size() == 2 && !wholeNumber(parts[1]))
        return Assignment{position, value, parts[0], std::nullopt, parts[1]};
    if (parts.size() == 3 && wholeNumber(parts[1]))
        return Assignment{position, value, parts[0], wholeNumber(parts[1]), parts[2]};
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

/// The table of the scene that an override writes to; nullptr, with the problem recorded, if there is no such table.
Value* tableOf(Value& root, const Assignment& assignment, ProblemList& problems) {
    if (assignment.table.empty()) return &root;
    const TableInfo* info = findTable(assignment.table);
    const bool isListOnly = info != nullptr && info->allowsList && !info->allowsSingle;
    const Entry* existing = findEntry(root, assignment.table);
    if (existing == nullptr && !isListOnly && assignment.index.value_or(0) == 0)
        return &findOrAdd(root, assignment.table, assignment.position).value;
    const bool isArray = existing != nullptr && existing->value.kind == ValueKind::array;
    const std::size_t count = isArray ? existing->value.items.size() : existing != nullptr ? 1 : 0;
    if (assignment.index.value_or(0) >= count) {
        problems.add(assignment.position,
                     count == 0 ? fmt::format("the scene has no [[{}]]", assignment.table)
                                : fmt::format("the scene has only {} [[{}]], counted from 0", count, assignment.table));
        return nullptr;
    }
    Value& value = findOrAdd(root, assignment.table, assignment.position).value;
    if (!isArray) return &value;
    if (assignment.index) return &value.items[*assignment.index];
    problems.add(assignment.position,
                 fmt::format("{} is a list, write {}[0].{}", assignment.table, assignment.table, assignment.name));
    return nullptr;
}

void apply(Value& root, const Assignment& assignment, ProblemList& problems) {
    Value* table = tableOf(root, assignment, problems);
    if (table == nullptr) return;
    if (table->kind != ValueKind::table) {
        // Where the schema expects a table, the later validation reports what the scene has instead.
        if (findTable(assignment.table) == nullptr)
            problems.add(assignment.position, fmt::format("{} is not a table, {} has no key {}", assignment.table,
                                                          assignment.table, assignment.name));
        return;
    }
    Entry& entry = findOrAdd(*table, assignment.name, assignment.position);
    entry.position = assignment.position;
    entry.value = parseOverrideValue(assignment.value, assignment.position.overrideIndex);
}

}  // namespace

void applyOverrides(Value& root, const Overrides& overrides, ProblemList& problems) {
    for (std::size_t index = 0; index < overrides.size(); ++index) {
        const SourcePosition position{.overrideIndex = static_cast<int>(index)};
        if (const auto assignment = parseAssignment(overrides[index].assignment, position))
            apply(root, *assignment, problems);
        else
            problems.add(position, "must be KEY=VALUE, with a key like fps, physics.step or body[0].radius");
    }
}

}  // namespace scenes
