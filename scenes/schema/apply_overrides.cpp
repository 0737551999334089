// Applies overrides, such as body[0].radius=0.5: splits the key into table, index and name, finds the table in the
// scene, and stores the value there.
#include "scenes/schema/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenes/schema/schema.h"

namespace scenes {
namespace {

/// A table in the key of an override, such as body[0].
struct TableStep {
    std::string name;
    std::optional<std::size_t> index;
};

/// An override such as "body[0].radius=0.5" or "obstacle[0].key[1].time=2".
struct Assignment {
    SourcePosition position;
    std::string value;
    std::vector<TableStep> tables;  ///< each within the one before; empty for a key above the first table
    std::string key;
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
    const std::vector<std::string> parts = partsOf(text.substr(0, equals));
    if (parts.empty() || std::ranges::any_of(parts, [](const std::string& part) { return part.empty(); }))
        return std::nullopt;
    Assignment assignment{position, text.substr(equals + 1), {}, parts.back()};
    std::string table;
    for (std::size_t at = 0; at + 1 < parts.size(); ++at) {
        table += (table.empty() ? "" : ".") + parts[at];
        // Only the schema tells which names between dots are tables within tables.
        if (!assignment.tables.empty() && findTable(table) == nullptr) return std::nullopt;
        assignment.tables.push_back({parts[at], std::nullopt});
        if (at + 2 < parts.size() && wholeNumber(parts[at + 1]))
            assignment.tables.back().index = wholeNumber(parts[++at]);
    }
    if (parts.size() > 1 && wholeNumber(parts.back())) return std::nullopt;
    return assignment;
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

/// Where an override looks for the next of its tables.
struct Location {
    Value* table;      ///< the scene, or the table found before
    std::string path;  ///< as in messages, "obstacle[0]"; empty for the scene
    std::string name;  ///< of the table in the schema: "obstacle"; empty for the scene
};

/// Goes from a table to one within it, or returns false with the problem recorded if there is none.
/// @param rest  what follows the step in the key of the override
bool enter(Location& location, const TableStep& step, const std::string& rest, const SourcePosition& position,
           ProblemList& problems) {
    const std::string name = location.name.empty() ? step.name : location.name + '.' + step.name;
    const std::string path = location.path.empty() ? step.name : location.path + '.' + step.name;
    const TableInfo* info = findTable(name);
    const bool isListOnly = info != nullptr && info->allowsList && !info->allowsSingle;
    const Entry* existing = findEntry(*location.table, step.name);
    const bool isArray = existing != nullptr && existing->value.kind == ValueKind::array;
    const std::size_t count = isArray ? existing->value.items.size() : existing != nullptr ? 1 : 0;
    const bool isAdded = existing == nullptr && !isListOnly && step.index.value_or(0) == 0;
    const std::string owner = location.path.empty() ? "the scene" : location.path;
    if (!isAdded && step.index.value_or(0) >= count) {
        problems.add(position, count == 0 ? fmt::format("{} has no [[{}]]", owner, name)
                                          : fmt::format("{} has only {} [[{}]], counted from 0", owner, count, name));
        return false;
    }
    if (isArray && !step.index) {
        problems.add(position, fmt::format("{} is a list, write {}[0].{}", path, path, rest));
        return false;
    }
    Value& value = findOrAdd(*location.table, step.name, position).value;
    location = {isArray ? &value.items[*step.index] : &value,
                step.index ? fmt::format("{}[{}]", path, *step.index) : path, name};
    return true;
}

/// The part of an override's key after the table with the given index.
std::string restOf(const Assignment& assignment, std::size_t table) {
    std::string rest;
    for (std::size_t next = table + 1; next < assignment.tables.size(); ++next) {
        const TableStep& step = assignment.tables[next];
        rest += step.index ? fmt::format("{}[{}].", step.name, *step.index) : step.name + '.';
    }
    return rest + assignment.key;
}

void apply(Value& root, const Assignment& assignment, ProblemList& problems) {
    Location location{&root, "", ""};
    for (std::size_t table = 0; table < assignment.tables.size(); ++table) {
        if (!enter(location, assignment.tables[table], restOf(assignment, table), assignment.position, problems))
            return;
        if (location.table->kind == ValueKind::table) continue;
        // Where the schema expects a table, the later validation reports what the scene has instead.
        if (findTable(location.name) == nullptr)
            problems.add(assignment.position, fmt::format("{} is not a table, {} has no key {}", location.name,
                                                          location.name, restOf(assignment, table)));
        return;
    }
    Entry& entry = findOrAdd(*location.table, assignment.key, assignment.position);
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
