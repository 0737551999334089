// Written keys first, then defaults, then what is missing.
#include "scenes/schema/read_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scenes/schema/document.h"
#include "scenes/text/edit_distance.h"

namespace scenes {
namespace {

/// The schema's defaults, checked like anything else. A row whose default does not fit its own bounds is a bug.
const Typed* fallbackOf(const Key& key) {
    static const std::map<std::string_view, Typed> kFallbacks = [] {
        std::map<std::string_view, Typed> fallbacks;
        ProblemList problems("schema", {});
        for (const Key& row : schema()) {
            if (row.fallback.empty()) continue;
            if (auto typed = checkValue(row, parseOverrideValue(std::string(row.fallback), -1), problems))
                fallbacks.emplace(row.path, std::move(*typed));
        }
        problems.throwIfAny();
        return fallbacks;
    }();
    const auto found = kFallbacks.find(key.path);
    return found == kFallbacks.end() ? nullptr : &found->second;
}

/// One table while it is read.
struct Reading {
    const TableSource& source;
    ProblemList& problems;
    Section section;
    std::string kind = {};  ///< value of the discriminator; empty if unknown
    Position kindAt = {};
};

std::string fullName(const TableInfo& info, std::string_view key) {
    return info.name.empty() ? std::string(key) : fmt::format("{}.{}", info.name, key);
}

/// Where a name of another table would belong; empty if nowhere.
std::string elsewhere(std::string_view name) {
    for (const Key& key : schema())
        if (nameOf(key) == name) return std::string(key.path);
    return {};
}

void reportUnknown(Reading& reading, const Entry& entry) {
    const TableInfo& info = reading.source.info;
    std::vector<std::string> names;
    for (const Key* key : keysOf(info.name)) names.emplace_back(nameOf(*key));
    std::string hint = nearestName(entry.key, names);
    if (!hint.empty()) {
        // The key that is meant is written, though not readable: it is not missing as well.
        reading.section.putUnfit(hint, entry.at);
        hint = fmt::format(", did you mean {}?", inQuotes(hint));
    } else if (const std::string home = elsewhere(entry.key); !home.empty()) {
        hint = home == entry.key ? ": it belongs above the first table"
                                 : fmt::format(", did you mean {}?", inQuotes(home));
    }
    reading.problems.add(entry.at, fmt::format("unknown key {}{}", inQuotes(fullName(info, entry.key)), hint));
    reading.section.markUnsound();
}

/// What the item before has for a key that this one leaves out. A key without a default, such as the time of a camera,
/// is each item's own.
const Typed* inheritedBy(const Reading& reading, const Key& key) {
    const Section* before = reading.source.before;
    const std::string_view name = nameOf(key);
    return before != nullptr && !key.fallback.empty() && before->has(name) ? &before->typed(name) : nullptr;
}

bool applies(const Reading& reading, const Key& key) {
    return key.appliesTo.empty() ||
           std::find(key.appliesTo.begin(), key.appliesTo.end(), reading.kind) != key.appliesTo.end();
}

void reportInapplicable(Reading& reading, const Entry& entry, const Key& key) {
    // An override that changes the shape makes the file's keys of the former shape moot, not wrong.
    if (reading.kindAt.overrideIndex >= 0 && entry.at.overrideIndex < 0) return;
    reading.problems.add(
        entry.at, fmt::format("{} does not apply to {} {}, only to {}", entry.key, reading.source.info.discriminator,
                              inQuotes(reading.kind), fmt::join(key.appliesTo, ", ")));
    reading.section.markUnsound();
}

void readEntry(Reading& reading, const Entry& entry) {
    const Key* key = findKey(reading.source.info.name, entry.key);
    if (key == nullptr) return reportUnknown(reading, entry);
    if (!reading.kind.empty() && !applies(reading, *key)) return reportInapplicable(reading, entry, *key);
    if (auto typed = checkValue(*key, entry.value, reading.problems))
        reading.section.put(entry.key, std::move(*typed), entry.value.at, Origin::given);
    else
        reading.section.putUnfit(entry.key, entry.value.at);
}

/// Finds out of which kind the table is, so that its other keys can be judged. Its own mistakes are found by readEntry.
void findKind(Reading& reading) {
    const std::string_view name = reading.source.info.discriminator;
    if (name.empty()) return;
    const Key& key = *findKey(reading.source.info.name, name);
    ProblemList ignored("", {});
    if (const Entry* entry = findEntry(reading.source.value, name)) {
        reading.kindAt = entry->at;
        if (const auto typed = checkValue(key, entry->value, ignored)) reading.kind = typed->text;
    } else if (const Typed* inherited = inheritedBy(reading, key)) {
        reading.kind = inherited->text;
    } else if (const Typed* fallback = fallbackOf(key)) {
        reading.kind = fallback->text;
    }
}

void reportMissing(Reading& reading, const Key& key) {
    reading.section.markUnsound();
    if (!reading.source.damaged) reading.problems.add(reading.section.at(), missingText(reading.section, key));
}

void completeKey(Reading& reading, const Key& key) {
    const std::string_view name = nameOf(key);
    if (reading.section.has(name) || !applies(reading, key)) return;
    if (const Typed* inherited = inheritedBy(reading, key))
        reading.section.put(name, *inherited, reading.section.at(), Origin::derived);
    else if (const Typed* fallback = fallbackOf(key))
        reading.section.put(name, *fallback, reading.section.at(), Origin::fallback);
    else if (key.required && !reading.section.isGiven(name))
        reportMissing(reading, key);
}

}  // namespace

std::string missingText(const Section& section, const Key& key) {
    const TableInfo& info = section.table();
    std::string who(info.article);
    if (!key.appliesTo.empty())
        who += fmt::format(" of {} {}", info.discriminator, section.canonical(info.discriminator));
    const std::string unit = key.unit.empty() ? "" : fmt::format(" ({})", unitWords(key.unit));
    return fmt::format("{} is missing, {} needs it{}", nameOf(key), who, unit);
}

Section readTable(const TableSource& source, ProblemList& problems) {
    Reading reading{source, problems, Section(source.info, source.prefix, source.value.at)};
    findKind(reading);
    for (const Entry& entry : source.value.entries) {
        // The tables of a scene are entries of its top; they are read on their own.
        const bool isTop = source.info.name.empty();
        const bool isTable =
            entry.value.kind == Kind::table ||
            (entry.value.kind == Kind::array && !entry.value.items.empty() && entry.value.items[0].kind == Kind::table);
        if (isTop && (isSection(entry.key) || (isTable && findKey("", entry.key) == nullptr))) continue;
        readEntry(reading, entry);
    }
    for (const Key* key : keysOf(source.info.name)) completeKey(reading, *key);
    return std::move(reading.section);
}

}  // namespace scenes
