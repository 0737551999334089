// Checks of tables of a scene, and records of problems in them, that several of the build_*.cpp files share.
#include <fmt/format.h>

#include <cmath>

#include "engine/state/state_checks.h"
#include "scenes/build/builders.h"
#include "scenes/model/to_float.h"
#include "scenes/text/edit_distance.h"

namespace scenes {

void checkWithinWorld(Section& section, std::string_view name, std::span<const engine::Vec3> positions,
                      BuildContext& context) {
    for (const engine::Vec3& position : positions) {
        if (engine::areBelow(position, engine::kWorldLimit)) continue;
        return report(section, name, context,
                      "a particle would be at ({:.7g}, {:.7g}, {:.7g}), must be less than {:g} m from the origin",
                      position.x(), position.y(), position.z(), engine::kWorldLimit);
    }
}

void reportMissing(Section& section, std::string_view name, BuildContext& context) {
    section.markInvalid();
    if (!context.hasOmissions)
        context.problems.add(section.position(), missingText(section, *findKey(section.table().name, name)));
}

bool settleConflict(Section& section, std::string_view one, std::string_view other, BuildContext& context) {
    if (!section.isGiven(one) || !section.isGiven(other)) return false;
    const auto isOverride = [&](std::string_view name) { return section.position(name).overrideIndex >= 0; };
    if (isOverride(one) != isOverride(other)) {
        section.erase(isOverride(one) ? other : one);
        return false;
    }
    const std::string_view later = section.position(other) < section.position(one) ? one : other;
    report(section, later, context, "{} and {} exclude each other, give one", one, other);
    return true;
}

void addExpectedParticles(Section& section, std::string_view name, double particles, std::string_view what,
                          BuildContext& context) {
    context.expectedParticles += particles;
    const double most = context.limits.particles;
    if (context.expectedParticles <= most) return;
    const std::string together = context.expectedParticles > particles
                                     ? fmt::format(", {:.2g} with those before", context.expectedParticles)
                                     : "";
    report(section, name, context, "{} about {:.2g} particles{}, {}", what, particles, together,
           allowedText("particles", most));
}

std::string allowedText(std::string_view limit, double most) {
    return fmt::format("at most {:.7g} are allowed; --limit {}=N allows more", most, limit);
}

void checkCorners(Section& section, Flatness flatness, BuildContext& context) {
    if (!section.has("minimum") || !section.has("maximum")) return;
    const bool mayBeFlat = flatness == Flatness::allowed;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = section.vector("minimum")[axis];
        const double high = section.vector("maximum")[axis];
        if (low < high || (mayBeFlat && low == high)) continue;
        report(section, "maximum", context, "maximum[{}] is {}, must be {} the minimum {} (meters)", axis,
               formatNumber(high), mayBeFlat ? "at least" : "above", formatNumber(low));
    }
}

std::optional<std::uint32_t> materialOf(Section& section, const Materials& materials, BuildContext& context) {
    if (!section.has("material")) return 0;
    const std::string& wanted = section.string("material");
    std::vector<std::string> names;
    for (std::uint32_t index = 0; index < materials.list.size(); ++index) {
        // A material whose name could not be read may be the one that the body or emitter refers to.
        if (materials.list[index].name == wanted || materials.list[index].name.empty()) return index;
        names.push_back(materials.list[index].name);
    }
    const std::string nearest = nearestName(wanted, names);
    const std::string hint = nearest.empty() ? fmt::format(" (defined: {})", fmt::join(names, ", "))
                                             : fmt::format(", did you mean {}?", tomlString(nearest));
    report(section, "material", context, "material {} is not defined{}", tomlString(wanted), hint);
    return std::nullopt;
}

std::optional<engine::Vec3> unitVector(const engine::Vec3& vector) {
    const double largest = vector.cwiseAbs().maxCoeff();
    if (largest == 0.0) return std::nullopt;
    // The vector is scaled to a largest component of 1 first, so that no square overflows or underflows.
    const engine::Vec3 scaled = vector / largest;
    return scaled / std::sqrt(engine::squaredLength(scaled));
}

std::optional<engine::Vec3> directionFrom(Section& section, std::string_view name, BuildContext& context) {
    const auto direction = unitVector(section.vector(name));
    if (!direction) report(section, name, context, "{} is [0, 0, 0], must not be zero", name);
    return direction;
}

render::Medium mediumFrom(const Section& section) {
    return {toFloat(section.number("transparency")), toFloat(section.number("refractive_index")),
            toFloat(section.number("attenuation_distance"))};
}

}  // namespace scenes
