// A validated table of a scene: typed values by key, with the schema's constant defaults filled in. The builders in
// build/ read sections, and add the defaults that depend on other keys.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/schema.h"
#include "scenes/schema/typed_value.h"

namespace scenes {

class Section {
 public:
    /// @param path      how messages and lists of values name the table, e.g. "body[0]"
    /// @param position  of its header
    Section(const TableInfo& table, std::string path, SourcePosition position);

    const TableInfo& table() const { return *table_; }
    const std::string& path() const { return path_; }

    /// Whether no problem was found in it; only then does every value exist that the schema says it has.
    bool isValid() const { return isValid_; }
    void markInvalid() { isValid_ = false; }

    /// Whether the key was written, with a valid value or not.
    bool isGiven(std::string_view name) const;
    /// Whether the key has a valid value, written or not.
    bool has(std::string_view name) const;
    ValueOrigin origin(std::string_view name) const { return slot(name).origin; }
    /// Position of the table's header.
    const SourcePosition& position() const { return position_; }
    /// Position of a written value; that of the header if the key was not written.
    SourcePosition position(std::string_view name) const;

    // The value of a key, which has to exist and to be of the type asked for.
    double number(std::string_view name) const { return typed(name).number; }
    std::int64_t integer(std::string_view name) const { return typed(name).integer; }
    bool boolean(std::string_view name) const { return typed(name).boolean; }
    const std::string& string(std::string_view name) const { return typed(name).string; }
    const std::vector<std::string>& strings(std::string_view name) const { return typed(name).strings; }
    const engine::Vec3& vector(std::string_view name) const { return typed(name).vectors.at(0); }
    const std::vector<engine::Vec3>& vectors(std::string_view name) const { return typed(name).vectors; }
    const std::vector<double>& numbers(std::string_view name) const { return typed(name).numbers; }
    const std::string& canonical(std::string_view name) const { return typed(name).canonical; }
    const TypedValue& typed(std::string_view name) const { return slot(name).value; }

    void put(std::string_view name, TypedValue value, SourcePosition position, ValueOrigin origin);
    /// Records that a key was written with an invalid value. It gets its default, if it has one.
    void putInvalid(std::string_view name, SourcePosition position);
    /// Removes a value, as if the key had never been written.
    void erase(std::string_view name);

    /// Sets a default that depends on other keys, unless the key was written.
    void derive(std::string_view name, TypedValue value);

 private:
    struct Slot {
        TypedValue value;
        SourcePosition position;
        ValueOrigin origin = ValueOrigin::schemaDefault;
    };

    const Slot& slot(std::string_view name) const;

    const TableInfo* table_;
    std::string path_;
    SourcePosition position_;
    bool isValid_ = true;
    std::map<std::string, Slot, std::less<>> slots_;
    std::map<std::string, SourcePosition, std::less<>> invalid_;  ///< keys written with invalid values
};

}  // namespace scenes
