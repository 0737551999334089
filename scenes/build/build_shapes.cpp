#include "scenes/build/build_shapes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/core/hash.h"
#include "engine/core/rotation.h"
#include "scenes/shapes/image_outline.h"
#include "scenes/shapes/mesh_distances.h"
#include "scenes/shapes/mesh_file.h"
#include "scenes/shapes/text_outline.h"
#include "scenes/text/read_file.h"

namespace scenes {
namespace {

using engine::Vec3;

std::string pathOf(const Section& section, const char* name, const BuildContext& context) {
    return (std::filesystem::path(context.folder) / section.string(name)).string();
}

double thicknessOf(const Section& section) {
    return section.has("thickness") ? section.number("thickness") : 0.0;
}

void requireKeys(Section& section, std::initializer_list<const char*> names, BuildContext& context) {
    for (const char* name : names)
        if (!section.isGiven(name)) reportMissing(section, name, context);
}

void checkProfile(Section& section, BuildContext& context) {
    if (!section.isValid()) return;
    const std::vector<double>& numbers = section.numbers("profile");
    for (std::size_t k = 0; k < numbers.size(); k += 2)
        if (numbers[k] < 0.0)
            return report(section, "profile", context, "profile[{}][0] is {}, must be >= 0: it is a radius (meters)",
                          k / 2, formatNumber(numbers[k]));
    section.derive("closed", TypedValue::ofBoolean(!section.has("thickness")));
    if (const std::string problem = profileProblem(profileFrom(section)); !problem.empty())
        report(section, "profile", context, "the profile {}", problem);
}

/// Records a problem if a hollow body is thicker than it is. Half its smallest extent is the most it can have.
void checkThickness(Section& section, BuildContext& context) {
    const std::string& shape = section.string("shape");
    if (!section.isValid() || !section.has("thickness") || shape == "revolution" || shape == "mesh") return;
    double most = 0.0;
    if (shape == "box")
        most = 0.5 * (section.vector("maximum") - section.vector("minimum")).minCoeff();
    else if (shape == "text" || shape == "image")
        most = 0.5 * section.number("depth");
    else
        most = section.has("top_radius") ? std::max(section.number("radius"), section.number("top_radius"))
                                         : section.number("radius");
    if (section.number("thickness") >= most)
        report(section, "thickness", context,
               "thickness is {}, must be less than {:.6g}, or nothing is hollow; leave it out to fill the whole inside",
               formatNumber(section.number("thickness")), most);
}

void readMeshOf(Section& section, BuildContext& context) {
    if (!section.has("file") || !section.has("scale")) return;
    const std::string path = pathOf(section, "file", context);
    if (context.meshes.count(path) > 0) return;
    context.files.emplace_back(path);
    try {
        Mesh mesh = readMesh(path);
        std::string_view bytes(reinterpret_cast<const char*>(mesh.points.data()), mesh.points.size() * sizeof(Vec3));
        context.contentHash = engine::fnv1a(bytes, context.contentHash);
        bytes = {reinterpret_cast<const char*>(mesh.triangles.data()),
                 mesh.triangles.size() * sizeof(mesh.triangles[0])};
        context.contentHash = engine::fnv1a(bytes, context.contentHash);
        context.meshes.emplace(path, std::move(mesh));
    } catch (const InputError& error) {
        section.markInvalid();
        context.problems.add(section.position("file"), error);
    }
}

/// Reads a file that a key names into the context.
void readBytesOf(Section& section, const char* name, BuildContext& context) {
    const std::string path = pathOf(section, name, context);
    if (context.contents.count(path) > 0) return;
    context.files.emplace_back(path);
    std::vector<std::uint8_t> bytes = readFile(path, kMaxParticleFileBytes);
    context.contentHash = engine::fnv1a(asText(bytes), context.contentHash);
    context.contents.emplace(path, std::move(bytes));
}

Extrusion textFrom(const Section& section, const BuildContext& context) {
    static const std::vector<std::uint8_t> kBuiltIn;
    const bool hasFont = section.has("font");
    const std::string path = hasFont ? pathOf(section, "font", context) : "DejaVu Sans";
    return {textOutline(section.string("text"), section.number("height"),
                        hasFont ? context.contents.at(path) : kBuiltIn, path),
            section.number("depth")};
}

Extrusion imageFrom(const Section& section, const BuildContext& context) {
    const std::string path = pathOf(section, "file", context);
    ImageOutline image = imageOutline(context.contents.at(path), path);
    const double width = section.has("width") ? section.number("width") : section.number("height") / image.aspect;
    for (auto& edge : image.outline.edges)
        for (OutlinePoint& point : edge) point = {width * point[0], width * point[1]};
    return {image.outline, section.number("depth")};
}

Extrusion extrusionFrom(const Section& section, const BuildContext& context) {
    return section.string("shape") == "text" ? textFrom(section, context) : imageFrom(section, context);
}

/// Reads the files of a text or an image, and records what is wrong with them.
void readOutlineOf(Section& section, BuildContext& context) {
    const bool isText = section.string("shape") == "text";
    const char* const fileKey = isText ? "font" : "file";
    const char* const source = section.isGiven(fileKey) ? fileKey : "text";
    if (!isText && !settleConflict(section, "width", "height", context) && !section.has("width") &&
        !section.has("height"))
        reportMissing(section, "width", context);
    if (!section.isValid()) return;
    try {
        if (section.has(fileKey)) readBytesOf(section, fileKey, context);
        if (extrusionFrom(section, context).isEmpty())
            report(section, isText ? "text" : "file", context, "{}",
                   isText ? "text has no letters, so that nothing is filled"
                          : "the image has no pixel that is darker than middle gray, so that nothing is filled");
    } catch (const InputError& error) {
        section.markInvalid();
        context.problems.add(section.position(source), error);
    }
}

void readShape(Section& section, BuildContext& context) {
    if (!section.has("shape")) return;
    const std::string& shape = section.string("shape");
    if (shape == "cylinder" || shape == "cone" || shape == "frustum" || shape == "capsule" || shape == "text")
        requireKeys(section, {"height"}, context);
    if (shape == "shell") requireKeys(section, {"thickness"}, context);
    if (shape == "revolution") checkProfile(section, context);
    if (shape == "capsule" && section.isValid() && section.number("height") < 2.0 * section.number("radius"))
        report(section, "height", context, "height is {}, must be at least twice the radius, {} (meters)",
               formatNumber(section.number("height")), formatNumber(2.0 * section.number("radius")));
    if (shape == "mesh") readMeshOf(section, context);
    if (shape == "text" || shape == "image") readOutlineOf(section, context);
    checkThickness(section, context);
}

}  // namespace

bool isTurned(const Section& section) {
    const std::string& shape = section.string("shape");
    return shape == "cylinder" || shape == "cone" || shape == "frustum" || shape == "capsule" || shape == "revolution";
}

bool isFilledSolid(const Section& section) {
    const std::string& shape = section.string("shape");
    if (shape == "box") return section.has("thickness") || section.vector("rotation") != Vec3::Zero();
    if (shape == "ball") return section.has("thickness");
    return shape != "grid" && shape != "points" && shape != "file";
}

void readShapes(std::vector<Section>& sections, BuildContext& context) {
    for (Section& section : sections) readShape(section, context);
}

ProfileSpec profileFrom(const Section& section) {
    const std::string& shape = section.string("shape");
    ProfileSpec spec;
    if (shape == "revolution") {
        const std::vector<double>& numbers = section.numbers("profile");
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) spec.points.push_back({numbers[k], numbers[k + 1]});
        spec.isClosed = section.boolean("closed");
        spec.thickness = thicknessOf(section);
        spec.isSmooth = section.boolean("smooth");
        if (section.has("fillet")) spec.fillet = section.number("fillet");
        return spec;
    }
    const double radius = section.number("radius");
    const double height = section.number("height");
    if (shape == "capsule") {
        spec.points = engine::capsuleProfile(radius, height);
        spec.isClosed = false;
        spec.thickness = 2.0 * radius;
    } else {
        const double top = shape == "cylinder" ? radius : shape == "cone" ? 0.0 : section.number("top_radius");
        spec.points = engine::frustumProfile(radius, top, height);
    }
    return spec;
}

const Mesh& meshFrom(const Section& section, const BuildContext& context) {
    return context.meshes.at(pathOf(section, "file", context));
}

Placement placementFrom(const Section& section, const BuildContext& context) {
    const std::string& shape = section.string("shape");
    Placement placement;
    if (shape == "box") {
        placement.center = 0.5 * (section.vector("minimum") + section.vector("maximum"));
    } else if (shape == "mesh" && !section.isGiven("center")) {
        placement.center = section.number("scale") * boundsOf(meshFrom(section, context)).middle();
    } else {
        placement.center = section.vector("center");
    }
    if (section.has("rotation")) placement.rotation = engine::rotationOfDegrees(section.vector("rotation"));
    return placement;
}

Mesh placedMeshFrom(const Section& section, const BuildContext& context) {
    return centeredMesh(meshFrom(section, context), section.number("scale"));
}

engine::DistanceGrid gridFrom(const Section& section, const VoxelGrid& wanted, BuildContext& context) {
    const Mesh mesh = placedMeshFrom(section, context);
    engine::DistanceGrid grid = distancesOf(mesh, wanted, pathOf(section, "file", context));
    context.meshNotes.push_back(fmt::format(
        "{}: {} triangles, watertight, {:.4g} m^3; distances from it on {:.2g} voxels of {:.3g} m, {:.3g} MB",
        section.string("file"), mesh.triangles.size(), massOf(mesh).volume,
        static_cast<double>(engine::voxelCount(grid.bricks())), wanted.voxel,
        static_cast<double>(engine::memoryOf(grid.bricks())) / 1e6));
    return grid;
}

namespace {

/// The solid of a body of any shape but mesh.
Solid closedFormFrom(const Section& section, const BuildContext& context) {
    const std::string& shape = section.string("shape");
    const Placement placement = placementFrom(section, context);
    const double thickness = thicknessOf(section);
    if (shape == "ball" || shape == "shell") return ballSolid(section.number("radius"), placement, thickness);
    if (shape == "box") return cuboidSolid(section.vector("maximum") - section.vector("minimum"), placement, thickness);
    if (!isTurned(section)) return extrusionSolid(extrusionFrom(section, context), placement, thickness);
    const ProfileSpec spec = profileFrom(section);
    return revolutionSolid(refinedProfile(spec), spec.isClosed, 0.5 * spec.thickness, placement,
                           shape == "revolution" ? 0.0 : thickness);
}

}  // namespace

Solid solidFrom(const Section& section, double voxel, BuildContext& context) {
    if (section.string("shape") != "mesh") return closedFormFrom(section, context);
    std::vector<Vec3> points = placedMeshFrom(section, context).points;
    return {gridFrom(section, {voxel, 3.0 * voxel}, context),
            {{}, std::move(points), 0.0},
            placementFrom(section, context),
            thicknessOf(section)};
}

double reachOf(const Section& section, const Vec3& direction, const BuildContext& context) {
    // The points of a mesh reach as far as its distances do, which take longer to find.
    if (section.string("shape") == "mesh")
        return pointSolid(placedMeshFrom(section, context).points, placementFrom(section, context)).reach(direction);
    return closedFormFrom(section, context).reach(direction);
}

}  // namespace scenes
