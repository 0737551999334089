// Storage of checked values.
#include "scenes/schema/section.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace scenes {

Section::Section(const TableInfo& table, std::string prefix, Position at)
    : table_(&table), prefix_(std::move(prefix)), at_(at) {}

bool Section::isGiven(std::string_view name) const {
    if (unfit_.find(name) != unfit_.end()) return true;
    const auto found = slots_.find(name);
    return found != slots_.end() && found->second.origin == Origin::given;
}

bool Section::has(std::string_view name) const {
    return slots_.find(name) != slots_.end();
}

Position Section::at(std::string_view name) const {
    if (const auto found = unfit_.find(name); found != unfit_.end()) return found->second;
    const auto found = slots_.find(name);
    return found != slots_.end() && found->second.origin == Origin::given ? found->second.at : at_;
}

const Section::Slot& Section::slot(std::string_view name) const {
    const auto found = slots_.find(name);
    if (found == slots_.end())
        throw std::logic_error(fmt::format("scene reader: {} has no value for {}", prefix_, name));
    return found->second;
}

void Section::put(std::string_view name, Typed value, Position at, Origin origin) {
    // A default may stand in for a value that does not fit; a value that was written stands for itself.
    if (origin == Origin::given) unfit_.erase(std::string(name));
    slots_.insert_or_assign(std::string(name), Slot{std::move(value), at, origin});
}

void Section::putUnfit(std::string_view name, Position at) {
    sound_ = false;
    if (!isGiven(name)) unfit_.insert_or_assign(std::string(name), at);
}

void Section::drop(std::string_view name) {
    slots_.erase(std::string(name));
}

void Section::deriveTyped(std::string_view name, Typed value) {
    if (findKey(table_->name, name) == nullptr)
        throw std::logic_error(fmt::format("scene reader: no key {} in {}", name, prefix_));
    if (!isGiven(name)) put(name, std::move(value), at_, Origin::derived);
}

void Section::deriveNumber(std::string_view name, double number) {
    Typed value;
    value.number = number;
    value.canonical = numberText(number);
    deriveTyped(name, std::move(value));
}

void Section::deriveVector(std::string_view name, const engine::Vec3& vector) {
    Typed value;
    value.vectors = {vector};
    value.canonical =
        fmt::format("[{}, {}, {}]", numberText(vector.x()), numberText(vector.y()), numberText(vector.z()));
    deriveTyped(name, std::move(value));
}

void Section::deriveFlag(std::string_view name, bool flag) {
    Typed value;
    value.flag = flag;
    value.canonical = flag ? "true" : "false";
    deriveTyped(name, std::move(value));
}

void Section::deriveText(std::string_view name, const std::string& text) {
    Typed value;
    value.text = text;
    value.canonical = inQuotes(text);
    deriveTyped(name, std::move(value));
}

void Section::deriveInterval(std::string_view name, double low, double high) {
    Typed value;
    value.numbers = {low, high};
    value.canonical = fmt::format("[{}, {}]", numberText(low), numberText(high));
    deriveTyped(name, std::move(value));
}

}  // namespace scenes
