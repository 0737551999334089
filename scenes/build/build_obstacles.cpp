// Builds obstacles, and how they are drawn: [[obstacle]].
#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Chosen: a gray that shows light and shade; linear RGB.
const Vec3 kObstacleColor(0.5, 0.5, 0.5);

/// Derives center and size of a box from its corners, or its corners from center and size.
void completeCorners(Section& section, BuildContext& context) {
    const bool hasCorners = section.isGiven("minimum") || section.isGiven("maximum");
    const bool hasCenter = section.isGiven("center") || section.isGiven("size");
    if (hasCorners && hasCenter)
        return report(section, section.isGiven("size") ? "size" : "center", context,
                      "give either minimum and maximum, or center and size");
    for (const char* name : {hasCenter ? "center" : "minimum", hasCenter ? "size" : "maximum"})
        if (!section.isGiven(name)) reportMissing(section, name, context);
    if (!section.isValid()) return;
    if (hasCenter) {
        section.derive("minimum", TypedValue::ofVector(section.vector("center") - 0.5 * section.vector("size")));
        section.derive("maximum", TypedValue::ofVector(section.vector("center") + 0.5 * section.vector("size")));
    } else {
        section.derive("center", TypedValue::ofVector(0.5 * (section.vector("minimum") + section.vector("maximum"))));
        section.derive("size", TypedValue::ofVector(section.vector("maximum") - section.vector("minimum")));
    }
}

engine::Plane planeFrom(Section& section, BuildContext& context) {
    engine::Plane plane;
    plane.point = section.vector("point");
    plane.normal = directionFrom(section, "normal", context).value_or(Vec3::UnitY());
    return plane;
}

engine::Obstacle obstacleFrom(Section& section, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (shape == "plane") return planeFrom(section, context);
    if (shape == "box") return engine::Box{section.vector("minimum"), section.vector("maximum")};
    if (shape == "container") return engine::Container{section.vector("minimum"), section.vector("maximum")};
    return engine::Sphere{section.vector("center"), section.number("radius"), section.string("repulsor") == "literal"};
}

ObstacleLook appearanceOf(Section& section, const Section& look) {
    const std::string& shape = section.string("shape");
    if (shape == "plane") return {.isVisible = false};
    const bool isContainer = shape == "container";
    if (shape != "sphere") section.derive("edges", TypedValue::ofBoolean(isContainer));
    section.derive("color", TypedValue::ofVector(isContainer ? look.vector("edge_color") : kObstacleColor));
    return {section.boolean("visible"), shape != "sphere" && section.boolean("edges"), section.vector("color")};
}

}  // namespace

Obstacles buildObstacles(std::vector<Section>& sections, const Section& look, BuildContext& context) {
    Obstacles obstacles;
    for (Section& section : sections) {
        if (!section.has("shape")) continue;
        const std::string& shape = section.string("shape");
        if (shape == "box" || shape == "container") {
            completeCorners(section, context);
            checkCorners(section, Flatness::forbidden, context);
        }
        if (shape == "sphere" && !section.isGiven("center")) reportMissing(section, "center", context);
        if (!section.isValid()) continue;
        obstacles.shapes.push_back(obstacleFrom(section, context));
        obstacles.looks.push_back(appearanceOf(section, look));
    }
    return obstacles;
}

}  // namespace scenes
