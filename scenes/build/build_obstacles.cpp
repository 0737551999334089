// Makes the obstacles of the simulation, and what is drawn of them, from the [[obstacle]] tables of a scene.
#include "scenes/build/builders.h"
#include "scenes/model/to_float.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Default color of boxes and spheres, linear RGB. Chosen: a gray that shows light and shade.
const Vec3 kObstacleColor(0.5, 0.5, 0.5);

/// Derives center and size of a box or container from its two corners, or the corners from center and size.
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

/// How an obstacle answers particles under the scaled wall law. Reports keys that the scene's law does not have.
engine::WallSurface surfaceFrom(Section& section, engine::WallLaw law, BuildContext& context) {
    if (law == engine::WallLaw::paper) {
        for (const char* name : {"restitution", "friction", "adhesion"})
            if (section.isGiven(name))
                report(section, name, context, "the paper's walls have no {}; leave out physics.wall = \"paper\"",
                       name);
        return {};
    }
    if (section.string("shape") == "sphere" && section.string("repulsor") == "literal")
        report(section, "repulsor", context,
               "\"literal\" is the repulsor of the paper's walls; it needs physics.wall = \"paper\"");
    engine::WallSurface surface;
    if (section.has("restitution")) surface.rebound = engine::reboundWith(section.number("restitution"));
    if (section.has("friction")) surface.friction = section.number("friction");
    surface.adhesion = section.number("adhesion");
    return surface;
}

/// Adds an obstacle to what is drawn. Planes are not drawn; boxes and containers may have edges.
void addToLook(Section& section, const Section& lookSection, Look& look, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (shape == "plane") return;
    const bool isContainer = shape == "container";
    if (shape != "sphere") section.derive("edges", TypedValue::ofBoolean(isContainer));
    const Vec3& edgeColor = lookSection.vector("edge_color");
    section.derive("color", TypedValue::ofVector(isContainer ? edgeColor : kObstacleColor));
    if (!section.boolean("visible")) {
        if (shape != "sphere" && section.isGiven("edges") && section.boolean("edges"))
            context.warnings.add(section.position("edges"),
                                 "edges = true draws nothing where visible is false; leave visible out, or edges");
        return;
    }
    const glm::vec3 color = toFloat(section.vector("color"));
    if (shape == "sphere") {
        look.spheres.push_back({section.vector("center"), section.number("radius"), color});
        return;
    }
    DrawnBox box{section.vector("minimum"), section.vector("maximum"), {}, {}};
    if (!isContainer) box.faces = color;
    if (section.boolean("edges")) box.edges = isContainer ? color : toFloat(edgeColor);
    look.boxes.push_back(box);
}

}  // namespace

void buildObstacles(std::vector<Section>& sections, const Section& physics, const Section& look, Scene& scene,
                    BuildContext& context) {
    const bool isPaper = physics.has("wall") && physics.string("wall") == "paper";
    scene.setup.obstacles.wall = isPaper ? engine::WallLaw::paper : engine::WallLaw::scaled;
    for (Section& section : sections) {
        if (!section.has("shape")) continue;
        const std::string& shape = section.string("shape");
        if (shape == "box" || shape == "container") {
            completeCorners(section, context);
            checkCorners(section, Flatness::forbidden, context);
        }
        if (shape == "sphere" && !section.isGiven("center")) reportMissing(section, "center", context);
        if (!section.isValid()) continue;
        engine::Obstacles& obstacles = scene.setup.obstacles;
        obstacles.shapes.push_back(obstacleFrom(section, context));
        obstacles.surfaces.push_back(surfaceFrom(section, obstacles.wall, context));
        addToLook(section, look, scene.look, context);
    }
}

}  // namespace scenes
