// [[obstacle]]: what particles bounce off, and what of it is drawn.
#include <fmt/format.h>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Gray that shows light and shade; linear.
const Vec3 kObstacleColor(0.5, 0.5, 0.5);

/// Two corners, or a middle and edge lengths; each pair gives the other.
void completeCorners(Section& section, BuildContext& context) {
    const bool corners = section.isGiven("minimum") || section.isGiven("maximum");
    const bool middle = section.isGiven("center") || section.isGiven("size");
    if (corners && middle)
        return report(section, section.isGiven("size") ? "size" : "center",
                      "give either minimum and maximum, or center and size", context);
    for (const char* name : {middle ? "center" : "minimum", middle ? "size" : "maximum"})
        if (!section.isGiven(name)) reportMissing(section, name, context);
    if (!section.isSound()) return;
    if (middle) {
        section.deriveVector("minimum", section.vector("center") - 0.5 * section.vector("size"));
        section.deriveVector("maximum", section.vector("center") + 0.5 * section.vector("size"));
    } else {
        section.deriveVector("center", 0.5 * (section.vector("minimum") + section.vector("maximum")));
        section.deriveVector("size", section.vector("maximum") - section.vector("minimum"));
    }
}

/// The plane's normal with unit length, also in the list of values.
engine::Plane planeFrom(Section& section, BuildContext& context) {
    engine::Plane plane;
    plane.point = section.vector("point");
    const auto normal = unitVector(section.vector("normal"));
    if (!normal) report(section, "normal", "normal is [0, 0, 0], must not be zero", context);
    plane.normal = normal.value_or(Vec3::UnitY());
    return plane;
}

engine::Obstacle colliderFrom(Section& section, BuildContext& context) {
    const std::string& shape = section.text("shape");
    if (shape == "plane") return planeFrom(section, context);
    if (shape == "box") return engine::Box{section.vector("minimum"), section.vector("maximum")};
    if (shape == "container") return engine::Container{section.vector("minimum"), section.vector("maximum")};
    return engine::Sphere{section.vector("center"), section.number("radius"), section.text("repulsor") == "literal"};
}

ObstacleLook lookOf(Section& section, const Section& look) {
    const std::string& shape = section.text("shape");
    if (shape == "plane") return {.visible = false};
    const bool isContainer = shape == "container";
    if (shape != "sphere") section.deriveFlag("edges", isContainer);
    section.deriveVector("color", isContainer ? look.vector("edge_color") : kObstacleColor);
    return {section.flag("visible"), shape != "sphere" && section.flag("edges"), section.vector("color")};
}

}  // namespace

Obstacles buildObstacles(std::vector<Section>& sections, const Section& look, BuildContext& context) {
    Obstacles obstacles;
    for (Section& section : sections) {
        if (!section.has("shape")) continue;
        const std::string& shape = section.text("shape");
        if (shape == "box" || shape == "container") {
            completeCorners(section, context);
            checkCorners(section, context);
        }
        if (shape == "sphere" && !section.isGiven("center")) reportMissing(section, "center", context);
        if (!section.isSound()) continue;
        obstacles.shapes.push_back(colliderFrom(section, context));
        obstacles.looks.push_back(lookOf(section, look));
    }
    return obstacles;
}

}  // namespace scenes
