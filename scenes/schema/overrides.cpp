// Takes an override's key apart, finds its table and puts the value there.
#include "scenes/schema/overrides.h"

#include <fmt/format.h>

#include <optional>

#include "scenes/schema/document.h"
#include "scenes/schema/schema.h"

namespace scenes {
namespace {

/// "body[0].radius" taken apart; table empty for a key at the top.
struct Target {
    std::string table;
    std::optional<std::size_t> index;
    std::string key;
};

std::optional<std::size_t> wholeNumber(const std::string& text) {
    // No scene has a million tables; longer numbers could overflow.
    if (text.empty() || text.size() > 6 || text.find_first_not_of("0123456789") != std::string::npos)
        return std::nullopt;
    return static_cast<std::size_t>(std::stoul(text));
}

/// The parts between dots, with body[0] read as body.0; empty if brackets are misplaced.
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

std::optional<Target> targetOf(const std::string& path) {
    const std::vector<std::string> parts = partsOf(path);
    for (const std::string& part : parts)
        if (part.empty()) return std::nullopt;
    if (parts.size() == 1) return Target{"", std::nullopt, parts[0]};
    if (parts.size() == 2 && !wholeNumber(parts[1])) return Target{parts[0], std::nullopt, parts[1]};
    if (parts.size() == 3 && wholeNumber(parts[1])) return Target{parts[0], wholeNumber(parts[1]), parts[2]};
    return std::nullopt;
}

Entry& findOrAdd(Value& table, const std::string& key, const Position& at) {
    if (Entry* entry = findEntry(table, key)) return *entry;
    Entry entry;
    entry.key = key;
    entry.at = entry.value.at = at;
    table.entries.push_back(std::move(entry));
    return table.entries.back();
}

struct Change {
    Target target;
    Position at;
};

/// The table an override writes to; nullptr, with the problem recorded, if the scene has none.
Value* tableFor(Value& root, const Change& change, ProblemList& problems) {
    const Target& target = change.target;
    if (target.table.empty()) return &root;
    const TableInfo* info = findTable(target.table);
    const bool onlyList = info != nullptr && info->list && !info->single;
    const Entry* existing = findEntry(root, target.table);
    const std::size_t count = existing == nullptr                   ? 0
                              : existing->value.kind == Kind::array ? existing->value.items.size()
                                                                    : 1;
    if (existing == nullptr && !onlyList && target.index.value_or(0) == 0)
        return &findOrAdd(root, target.table, change.at).value;
    if (target.index.value_or(0) >= count) {
        problems.add(change.at, fmt::format("the scene has {} {}", count == 0 ? "no" : fmt::format("only {}", count),
                                            count == 0 ? fmt::format("[[{}]]", target.table)
                                                       : fmt::format("[[{}]], counted from 0", target.table)));
        return nullptr;
    }
    Value& value = findEntry(root, target.table)->value;
    if (value.kind != Kind::array) return &value;
    if (target.index) return &value.items[*target.index];
    problems.add(change.at, fmt::format("{} is a list, write {}[0].{}", target.table, target.table, target.key));
    return nullptr;
}

void applyOne(Value& root, const std::string& text, Position at, ProblemList& problems) {
    const std::size_t equals = text.find('=');
    const auto target = equals == std::string::npos ? std::nullopt : targetOf(text.substr(0, equals));
    if (!target) {
        problems.add(at, "must be KEY=VALUE, with a key like fps, physics.step or body[0].radius");
        return;
    }
    Value* table = tableFor(root, {*target, at}, problems);
    if (table == nullptr) return;
    if (table->kind != Kind::table) {
        // Of what should be a table the checks say what is wrong with it.
        if (findTable(target->table) == nullptr)
            problems.add(at,
                         fmt::format("{} is no table, {} has no key {}", target->table, target->table, target->key));
        return;
    }
    Entry& entry = findOrAdd(*table, target->key, at);
    entry.at = at;
    entry.value = parseOverrideValue(text.substr(equals + 1), at.overrideIndex);
}

}  // namespace

void applyOverrides(Value& root, const Overrides& overrides, ProblemList& problems) {
    for (std::size_t index = 0; index < overrides.size(); ++index)
        applyOne(root, overrides[index].change, {0, 0, static_cast<int>(index)}, problems);
}

}  // namespace scenes
