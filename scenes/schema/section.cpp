// Storage for the validated values of a table of a scene.
#include "scenes/schema/section.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace scenes {

Section::Section(const TableInfo& table, std::string path, SourcePosition position)
    : table_(&table), path_(std::move(path)), position_(position) {}

const std::vector<Section>& Section::list(std::string_view name) const {
    static const std::vector<Section> kNone;
    const auto found = lists_.find(name);
    return found == lists_.end() ? kNone : found->second;
}

bool Section::isGiven(std::string_view name) const {
    if (invalid_.find(name) != invalid_.end()) return true;
    const auto found = slots_.find(name);
    return found != slots_.end() && found->second.origin == ValueOrigin::given;
}

bool Section::has(std::string_view name) const {
    return slots_.find(name) != slots_.end();
}

SourcePosition Section::position(std::string_view name) const {
    if (const auto found = invalid_.find(name); found != invalid_.end()) return found->second;
    const auto found = slots_.find(name);
    return found != slots_.end() && found->second.origin == ValueOrigin::given ? found->second.position : position_;
}

const Section::Slot& Section::slot(std::string_view name) const {
    const auto found = slots_.find(name);
    if (found == slots_.end()) throw std::logic_error(fmt::format("scene reader: {} has no value for {}", path_, name));
    return found->second;
}

void Section::put(std::string_view name, TypedValue value, SourcePosition position, ValueOrigin origin) {
    // A valid value that was written replaces an invalid one. A default does not: the key still counts as written.
    if (origin == ValueOrigin::given) invalid_.erase(std::string(name));
    slots_.insert_or_assign(std::string(name), Slot{std::move(value), position, origin});
}

void Section::putInvalid(std::string_view name, SourcePosition position) {
    isValid_ = false;
    if (!isGiven(name)) invalid_.insert_or_assign(std::string(name), position);
}

void Section::erase(std::string_view name) {
    slots_.erase(std::string(name));
}

void Section::derive(std::string_view name, TypedValue value) {
    if (findKey(table_->name, name) == nullptr)
        throw std::logic_error(fmt::format("scene reader: no key {} in {}", name, path_));
    if (!isGiven(name)) put(name, std::move(value), position_, ValueOrigin::derived);
}

}  // namespace scenes
