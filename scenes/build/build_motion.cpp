// Motions of what a scene moves: a constant velocity and a spin, or a path of keys.
#include <numbers>
#include <utility>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

constexpr double kRadiansPerTurn = 2.0 * std::numbers::pi;

/// The keys of a path; what the first of them leave out is as it would be at rest.
std::vector<engine::PoseKey> pathFrom(const std::vector<Section>& keys, const Vec3& pivot, const Vec3& angles) {
    std::vector<engine::PoseKey> path;
    for (const Section& key : keys)
        path.push_back({.time = key.number("time"),
                        .position = key.has("position") ? key.vector("position") : pivot,
                        .angles = key.has("rotation") ? key.vector("rotation") : angles});
    return path;
}

}  // namespace

engine::Motion motionFrom(Section& section, std::string_view velocity, const Vec3& pivot, BuildContext& context) {
    engine::Motion motion{.pivot = pivot};
    if (section.has("rotation")) motion.angles = section.vector("rotation");
    if (section.has(velocity)) motion.velocity = section.vector(velocity);
    if (section.has("spin")) motion.spin = kRadiansPerTurn * section.vector("spin");
    const std::vector<Section>& keys = std::as_const(section).list("key");
    if (keys.empty()) return motion;
    for (const std::string_view name : {velocity, std::string_view("spin")})
        if (section.isGiven(name))
            report(section, name, context, "{} and [[{}.key]] exclude each other, give one", name,
                   section.table().name);
    for (const Section& key : keys)
        if (!key.isValid() || !key.has("time")) section.markInvalid();
    if (section.isValid()) motion.keys = pathFrom(keys, pivot, motion.angles);
    return motion;
}

}  // namespace scenes
