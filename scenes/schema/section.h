// A Section is a validated table of a scene file: typed values by key, with the schema's constant defaults filled in.
// scenes/build/ reads sections, and adds the defaults that depend on other keys.
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
    /// @param path      name of the table in messages and lists of values, e.g. "body[0]" or "obstacle[0].key[1]"
    /// @param position  position of the table's header
    Section(const TableInfo& table, std::string path, SourcePosition position);

    const TableInfo& table() const { return *table_; }
    const std::string& path() const { return path_; }

    /// Whether no problem was found in the table. Only then does every key have a value that the schema requires or
    /// gives a default.
    bool isValid() const { return isValid_; }
    void markInvalid() { isValid_ = false; }

    /// The tables of a list within this one: "key" for the [[obstacle.key]] of an [[obstacle]]. Empty if there is none.
    const std::vector<Section>& list(std::string_view name) const;
    std::vector<Section>& list(std::string_view name) { return lists_[std::string(name)]; }
    /// Calls visit(section) for this section, and then for each one within it.
    template <class Visit>
    void visitAll(const Visit& visit) const {
        visit(*this);
        for (const auto& [name, sections] : lists_)
            for (const Section& section : sections) section.visitAll(visit);
    }

    /// Whether a key was written, with a valid value or not.
    bool isGiven(std::string_view name) const;
    /// Whether a key has a valid value, a written one or a default.
    bool has(std::string_view name) const;
    ValueOrigin origin(std::string_view name) const { return slot(name).origin; }
    /// Position of the table's header.
    const SourcePosition& position() const { return position_; }
    /// Position of a key's written value; position of the header if the key was not written.
    SourcePosition position(std::string_view name) const;

    // The functions below return the value of a key. It has to exist, and its type has to be that of the function.
    double number(std::string_view name) const { return typed(name).number; }
    std::int64_t integer(std::string_view name) const { return typed(name).integer; }
    const render::FrameRate& frameRate(std::string_view name) const { return typed(name).frameRate; }
    bool boolean(std::string_view name) const { return typed(name).boolean; }
    const std::string& string(std::string_view name) const { return typed(name).string; }
    const std::vector<std::string>& strings(std::string_view name) const { return typed(name).strings; }
    const engine::Vec3& vector(std::string_view name) const { return typed(name).vectors.at(0); }
    const std::vector<engine::Vec3>& vectors(std::string_view name) const { return typed(name).vectors; }
    const std::vector<double>& numbers(std::string_view name) const { return typed(name).numbers; }
    const std::string& canonical(std::string_view name) const { return typed(name).canonical; }
    const TypedValue& typed(std::string_view name) const { return slot(name).value; }

    void put(std::string_view name, TypedValue value, SourcePosition position, ValueOrigin origin);
    /// Records that a key was written with an invalid value, in whose place it may get its default.
    void putInvalid(std::string_view name, SourcePosition position);
    /// Removes the value of a key, as if the key had never been written.
    void erase(std::string_view name);

    /// Sets the default of a key that depends on other keys, unless the key was written.
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
    std::map<std::string, SourcePosition, std::less<>> invalid_;      ///< position of each invalid value, by key
    std::map<std::string, std::vector<Section>, std::less<>> lists_;  ///< the tables within this one
};

}  // namespace scenes
