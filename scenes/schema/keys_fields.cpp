// Keys of [[field]].
#include "scenes/schema/keys.h"

namespace scenes {

std::vector<Key> fieldKeys() {
    return {
        key("kind", Type::choice, "",
            "the same acceleration everywhere; an acceleration toward a center; a drag toward a flow that turns; or a "
            "drag toward a wind")
            .required()
            .oneOf({"uniform", "point", "vortex", "drag"}),
        key("acceleration", Type::vec3, "m/s^2", "acceleration of particles, besides gravity")
            .required()
            .within(kWithinWorld)
            .onlyFor({"uniform"}),
        position("center", "what particles are drawn to, or a point of the axis that the flow turns about")
            .required()
            .onlyFor({"point", "vortex"}),
        key("strength", Type::number, "m^3/s^2",
            "acceleration toward the center times the squared distance to it, far away; below 0 it pushes away")
            .required()
            .within(kWithinWorld)
            .onlyFor({"point"}),
        key("softening", Type::number, "m",
            "distance from the center below which the acceleration falls to zero; it is strongest at 0.7 of it")
            .required()
            .within({.low = 1e-6, .high = engine::kWorldLimit})
            .onlyFor({"point"}),
        key("spin", Type::vec3, "turns/s", "turning of the flow: the axis, times turns a second")
            .required()
            .within({.low = -1e4, .high = 1e4})
            .onlyFor({"vortex"}),
        velocity("velocity", "velocity of the wind").defaultsTo("[0, 0, 0]").onlyFor({"drag"}),
        key("rate", Type::number, "1/s", "the velocity relative to the flow decays like exp(-rate t)")
            .required()
            .within({.low = 0.0, .high = 1e9})
            .onlyFor({"vortex", "drag"}),
        position("minimum", "corner with the smallest coordinates of the box that the field acts in")
            .derivedAs("no bound"),
        position("maximum", "corner with the largest coordinates of the box that the field acts in")
            .derivedAs("no bound"),
        key("start", Type::number, "s", "the field acts from this time on").defaultsTo("0").within(kNotNegative),
        key("until", Type::number, "s", "the field acts up to this time").derivedAs("no end").within(kPositive),
    };
}

}  // namespace scenes
