// A table of a scene after the checks: typed values by name, with defaults filled in. The builders read these and add
// the defaults that depend on other keys.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/check.h"
#include "scenes/schema/schema.h"

namespace scenes {

/// Where a value came from.
enum class Origin {
    given,     ///< the file or an override
    fallback,  ///< the schema's default
    derived    ///< a default that a builder worked out
};

class Section {
 public:
    /// prefix: how messages and lists name the table, e.g. "body[0]"; at: its header.
    Section(const TableInfo& table, std::string prefix, Position at);

    const TableInfo& table() const { return *table_; }
    const std::string& prefix() const { return prefix_; }
    const Position& at() const { return at_; }

    /// Whether nothing is wrong with it; only then do the values below all exist as the schema says.
    bool isSound() const { return sound_; }
    void markUnsound() { sound_ = false; }

    /// The key was written, readable or not.
    bool isGiven(std::string_view name) const;
    /// There is a usable value.
    bool has(std::string_view name) const;
    Origin origin(std::string_view name) const { return slot(name).origin; }
    /// Where the value was written; the header if it was not.
    Position at(std::string_view name) const;

    double number(std::string_view name) const { return slot(name).value.number; }
    std::int64_t integer(std::string_view name) const { return slot(name).value.integer; }
    bool flag(std::string_view name) const { return slot(name).value.flag; }
    const std::string& text(std::string_view name) const { return slot(name).value.text; }
    const std::vector<std::string>& texts(std::string_view name) const { return slot(name).value.texts; }
    const engine::Vec3& vector(std::string_view name) const { return slot(name).value.vectors.at(0); }
    const std::vector<engine::Vec3>& vectors(std::string_view name) const { return slot(name).value.vectors; }
    const std::vector<double>& numbers(std::string_view name) const { return slot(name).value.numbers; }
    const Typed& typed(std::string_view name) const { return slot(name).value; }
    const std::string& canonical(std::string_view name) const { return slot(name).value.canonical; }

    void put(std::string_view name, Typed value, Position at, Origin origin);
    /// Remembers a key that was written but does not fit; it keeps its default, if it has one.
    void putUnfit(std::string_view name, Position at);

    /// Forgets a value: it is as if there had never been one.
    void drop(std::string_view name);

    /// Sets what a builder worked out, unless the key was written.
    void deriveNumber(std::string_view name, double number);
    void deriveVector(std::string_view name, const engine::Vec3& vector);
    void deriveFlag(std::string_view name, bool flag);
    void deriveText(std::string_view name, const std::string& text);
    void deriveInterval(std::string_view name, double low, double high);

 private:
    struct Slot {
        Typed value;
        Position at;
        Origin origin = Origin::fallback;
    };

    const Slot& slot(std::string_view name) const;
    void deriveTyped(std::string_view name, Typed value);

    const TableInfo* table_;
    std::string prefix_;
    Position at_;
    bool sound_ = true;
    std::map<std::string, Slot, std::less<>> slots_;
    std::map<std::string, Position, std::less<>> unfit_;
};

}  // namespace scenes
