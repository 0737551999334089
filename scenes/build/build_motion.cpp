#include "scenes/build/build_motion.h"

#include <numbers>

namespace scenes {
namespace {

using engine::Vec3;

constexpr double kDegree = std::numbers::pi / 180.0;  // rad
constexpr double kTurn = 2.0 * std::numbers::pi;      // rad

/// A path excludes what describes a motion without one.
void checkPath(Section& section, BuildContext& context) {
    if (section.list("key").empty()) return;
    for (const char* name : {"velocity", "spin"})
        if (section.isGiven(name))
            report(section, name, context,
                   "{} and a path exclude each other; give either, or keys of the path that do the same", name);
}

}  // namespace

engine::Motion motionFrom(Section& section, const Vec3& middle, BuildContext& context) {
    section.derive("pivot", TypedValue::ofVector(middle));
    checkPath(section, context);
    engine::Motion motion;
    motion.pivot = section.vector("pivot");
    motion.angles = kDegree * section.vector("rotation");
    motion.velocity = section.vector("velocity");
    motion.spin = kTurn * section.vector("spin");
    if (section.has("until")) motion.until = section.number("until");
    for (Section& key : section.list("key")) {
        const bool isFirst = motion.keys.empty();
        // Each key takes what it leaves out from the one before, and the first from the obstacle.
        key.derive("position", TypedValue::ofVector(isFirst ? motion.pivot : motion.keys.back().position));
        key.derive("rotation", TypedValue::ofVector(isFirst ? section.vector("rotation")
                                                            : Vec3(motion.keys.back().angles / kDegree)));
        motion.keys.push_back({key.number("time"), key.vector("position"), kDegree * key.vector("rotation")});
    }
    section.derive("record", TypedValue::ofBoolean(!motion.isAtRest()));
    return motion;
}

}  // namespace scenes
