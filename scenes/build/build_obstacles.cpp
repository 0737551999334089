// Makes the obstacles of the simulation, and what is drawn of them, from the [[obstacle]] tables of a scene.
#include <algorithm>
#include <limits>
#include <memory>

#include "engine/core/sine.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "scenes/build/build_shapes.h"
#include "scenes/build/builders.h"
#include "scenes/model/to_float.h"
#include "scenes/shapes/mesh_distances.h"
#include "scenes/shapes/tessellation.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Default color of boxes and spheres, linear RGB. Chosen: a gray that shows light and shade.
const Vec3 kObstacleColor(0.5, 0.5, 0.5);
/// Default color of transparent obstacles, linear RGB. Chosen: window glass, greenish where it is thick.
const Vec3 kGlassColor(0.75, 0.9, 0.82);

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

/// A shape, and what is needed to draw it.
struct BuiltShape {
    engine::Obstacle shape;
    std::shared_ptr<const render::SolidMesh> mesh;  ///< around the middle of the shape, where it is drawn as triangles
    Vec3 middle = Vec3::Zero();                     ///< the point that the obstacle turns about by itself, m
};

BuiltShape turnedFrom(const Section& section) {
    const ProfileSpec spec = profileFrom(section);
    const Profile profile = refinedProfile(spec);
    const double half = 0.5 * spec.thickness;
    const Vec3& center = section.vector("center");
    return {engine::revolutionSolid(engine::Revolution(profile, spec.isClosed, half), center),
            std::make_shared<const render::SolidMesh>(revolutionMesh(profile, spec.isClosed, half)), center};
}

BuiltShape meshObstacleFrom(const Section& section, const VoxelGrid& grid, BuildContext& context) {
    const Vec3 center = placementFrom(section, context).center;
    return {engine::meshSolid(gridFrom(section, grid, context), center),
            std::make_shared<const render::SolidMesh>(smoothMesh(placedMeshFrom(section, context))), center};
}

BuiltShape shapeFrom(Section& section, const VoxelGrid& grid, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (isTurned(section)) return turnedFrom(section);
    if (shape == "mesh") return meshObstacleFrom(section, grid, context);
    if (shape == "plane") return {planeFrom(section, context), {}, section.vector("point")};
    if (shape == "sphere") {
        const Vec3& center = section.vector("center");
        return {engine::Sphere{center, section.number("radius"), section.string("repulsor") == "literal"}, {}, center};
    }
    const Vec3& low = section.vector("minimum");
    const Vec3& high = section.vector("maximum");
    const Vec3 middle = 0.5 * (low + high);
    if (shape == "container") return {engine::Container{low, high}, {}, middle};
    return {engine::Box{low, high}, std::make_shared<const render::SolidMesh>(cuboidMesh(high - low)), middle};
}

/// How an obstacle answers particles under the scaled wall law. Reports keys that the scene's law does not have.
engine::WallSurface surfaceFrom(Section& section, engine::WallLaw law, BuildContext& context) {
    if (law == engine::WallLaw::paper) {
        for (const char* name : {"restitution", "friction", "adhesion", "contact_angle"})
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
    surface.wetting = 1.0 + engine::sineAndCosineOfDegrees(section.number("contact_angle")).cosine;
    return surface;
}

/// The edges of an obstacle: those of a box or container, and the sharp ones of a solid's mesh.
std::vector<Line> edgesOf(const Section& section, const BuiltShape& built) {
    if (section.has("minimum")) return edgesOfBox(section.vector("minimum"), section.vector("maximum"));
    return isTurned(section) ? outlinesOf(profileFrom(section), built.middle) : sharpEdges(*built.mesh, built.middle);
}

/// Adds an obstacle to what is drawn. Planes are not drawn; all but spheres may have edges.
void addToLook(Section& section, const BuiltShape& built, std::size_t obstacle, bool isPlaced,
               const Section& lookSection, Look& look, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (shape == "plane") return;
    const bool isContainer = shape == "container";
    if (shape != "sphere") section.derive("edges", TypedValue::ofBoolean(isContainer));
    const Vec3& edgeColor = lookSection.vector("edge_color");
    const render::Medium medium = isContainer ? render::Medium{} : mediumFrom(section);
    const Vec3& surfaceColor = medium.isTransparent() ? kGlassColor : kObstacleColor;
    section.derive("color", TypedValue::ofVector(isContainer ? edgeColor : surfaceColor));
    if (!section.boolean("visible")) {
        if (shape != "sphere" && section.isGiven("edges") && section.boolean("edges"))
            context.warnings.add(section.position("edges"),
                                 "edges = true draws nothing where visible is false; leave visible out, or edges");
        return;
    }
    const glm::vec3 color = toFloat(section.vector("color"));
    if (shape == "sphere" && !medium.isTransparent()) {
        look.spheres.push_back({obstacle, section.vector("center"), section.number("radius"), color});
        return;
    }
    if (shape == "sphere") {
        const auto mesh = std::make_shared<const render::SolidMesh>(ballMesh(section.number("radius")));
        look.solids.push_back({obstacle, mesh, built.middle, color, medium});
        return;
    }
    const bool hasFaces = !isContainer && section.boolean("faces");
    if (hasFaces && shape == "box" && !isPlaced && !medium.isTransparent())
        look.boxes.push_back({obstacle, section.vector("minimum"), section.vector("maximum"), color});
    else if (hasFaces)
        look.solids.push_back({obstacle, built.mesh, built.middle, color, medium});
    if (section.boolean("edges"))
        look.edges.push_back({obstacle, edgesOf(section, built), isContainer ? color : toFloat(edgeColor)});
}

/// Reports what the paper's walls do not have.
void checkPaperWalls(Section& section, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (isTurned(section) || shape == "mesh")
        report(section, "shape", context, "a {} is not an obstacle of the paper's walls; leave out physics.wall",
               shape);
    for (const char* name : {"rotation", "velocity", "spin", "pivot", "until", "record"})
        if (section.isGiven(name))
            report(section, name, context, "{} does not apply to the paper's walls, which rest; leave out physics.wall",
                   name);
    for (const Section& key : section.list("key")) {
        section.markInvalid();
        context.problems.add(key.position(), "the paper's walls rest; leave out physics.wall, or the keys of the path");
    }
}

/// The grid of the distances from a mesh: voxels are half as wide as the smallest particle's radius, and the band
/// reaches as far as a surface may act on the largest.
VoxelGrid voxelGridFor(const Materials& materials, const std::vector<Section>& sections, const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    const auto include = [&](double radius) {
        smallest = std::min(smallest, radius);
        largest = std::max(largest, radius);
    };
    for (const engine::Material& material : materials.list) include(material.radius);
    for (const double radius : scene.setup.initial.radius) include(radius);
    const double voxel = 0.5 * smallest;
    const bool isWetted = std::ranges::any_of(sections, [](const Section& section) {
        return section.has("contact_angle") && section.number("contact_angle") < 180.0;
    });
    return {voxel, engine::largestContactReach(isWetted, largest) + voxel};
}

/// Checks the keys of an obstacle's shape against one another.
void checkShape(Section& section, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (shape == "box" || shape == "container") {
        completeCorners(section, context);
        checkCorners(section, Flatness::forbidden, context);
    }
    if (shape == "sphere" && !section.isGiven("center")) reportMissing(section, "center", context);
    if (isTurned(section)) section.derive("center", TypedValue::ofVector(Vec3::Zero()));
}

void buildObstacle(Section& section, const VoxelGrid& grid, const Section& look, Scene& scene, BuildContext& context) {
    engine::Obstacles& obstacles = scene.setup.obstacles;
    const BuiltShape built = shapeFrom(section, grid, context);
    section.derive("pivot", TypedValue::ofVector(built.middle));
    engine::Motion motion = motionFrom(section, "velocity", section.vector("pivot"), context);
    if (section.has("until")) motion.until = section.number("until");
    section.derive("record", TypedValue::ofBoolean(!motion.isAtRest()));
    if (!section.isValid()) return;
    const std::size_t index = obstacles.shapes.size();
    obstacles.shapes.push_back(built.shape);
    scene.obstacleShapes.push_back(section.string("shape"));
    obstacles.surfaces.push_back(surfaceFrom(section, obstacles.wall, context));
    obstacles.motions.push_back(motion);
    obstacles.areRecorded.push_back(section.boolean("record"));
    addToLook(section, built, index, !motion.isIdentity(), look, scene.look, context);
}

}  // namespace

void buildObstacles(std::vector<Section>& sections, const Section& physics, const Section& look,
                    const Materials& materials, Scene& scene, BuildContext& context) {
    engine::Obstacles& obstacles = scene.setup.obstacles;
    const bool isPaper = physics.has("wall") && physics.string("wall") == "paper";
    obstacles.wall = isPaper ? engine::WallLaw::paper : engine::WallLaw::scaled;
    const VoxelGrid grid = voxelGridFor(materials, sections, scene);
    for (Section& section : sections) {
        if (!section.has("shape")) continue;
        checkShape(section, context);
        if (isPaper) checkPaperWalls(section, context);
        if (!section.isValid()) continue;
        try {
            buildObstacle(section, grid, look, scene, context);
        } catch (const InputError& error) {
            section.markInvalid();
            context.problems.add(section.position("file"), error);
        }
    }
    // A scene without motion has no poses to compute.
    if (std::ranges::all_of(obstacles.motions, &engine::Motion::isIdentity)) obstacles.motions.clear();
    if (std::ranges::none_of(obstacles.areRecorded, [](bool isRecorded) { return isRecorded; }))
        obstacles.areRecorded.clear();
}

}  // namespace scenes
