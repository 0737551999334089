// Words for fields.
#include "scenes/model/field_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace scenes {
namespace {

using engine::Vec3;

std::string lawText(const engine::UniformField& field) {
    return fmt::format("acceleration of {} m/s^2", vectorText(field.acceleration));
}

std::string lawText(const engine::PointField& field) {
    return fmt::format("{} {} m, at most {:.4g} m/s^2", field.strength < 0.0 ? "push away from" : "pull toward",
                       vectorText(field.center), engine::largestAcceleration(field));
}

std::string lawText(const engine::FlowField& field) {
    // The velocity relative to the flow falls to exp(-1) in the time 1 / rate.
    const std::string drag = field.rate > 0.0
                                 ? fmt::format("which takes {:.4g} s to drag along two thirds", 1.0 / field.rate)
                                 : "which drags nothing along, for its rate is 0";
    const double turns = field.spin.norm() / (2.0 * std::numbers::pi);
    if (turns > 0.0) return fmt::format("vortex of {:.4g} turns/s about {}, {}", turns, vectorText(field.center), drag);
    if (field.velocity == Vec3::Zero()) return fmt::format("still air, {}", drag);
    return fmt::format("wind of {} m/s, {}", vectorText(field.velocity), drag);
}

std::string boxText(const engine::BoundingBox& box) {
    const bool isBelow = box.high.allFinite();
    if (!box.low.allFinite()) return fmt::format(", below {} m", vectorText(box.high));
    if (!isBelow) return fmt::format(", above {} m", vectorText(box.low));
    return fmt::format(", from {} to {} m", vectorText(box.low), vectorText(box.high));
}

}  // namespace

std::string vectorText(const Vec3& vector) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", vector.x(), vector.y(), vector.z());
}

std::string fieldText(const engine::Field& field) {
    std::string text = std::visit([](const auto& law) { return lawText(law); }, field.law);
    if (field.box) text += boxText(*field.box);
    if (field.start > 0.0) text += fmt::format(", from {:.4g} s on", field.start);
    if (std::isfinite(field.until)) text += fmt::format(", until {:.4g} s", field.until);
    return text;
}

}  // namespace scenes
