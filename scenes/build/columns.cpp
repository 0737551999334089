// Measures bodies along the direction of gravity.
#include "scenes/build/columns.h"

#include <algorithm>
#include <cmath>

#include "engine/state/bodies.h"
#include "scenes/build/build_shapes.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Spacing of the face-centered cubic lattice that has as many particles in a volume as a cubic lattice of spacing 1:
/// the sixth root of 2.
constexpr double kCubicSpacing = 1.122462048309373;

double gravityOf(const BuildContext& context) {
    return std::sqrt(engine::squaredLength(context.gravity));
}

/// Height of a box of the given edge lengths (m) along the direction of gravity, m.
double heightOf(const Vec3& size, const BuildContext& context) {
    return std::abs(size.x() * context.gravity.x()) / gravityOf(context) +
           std::abs(size.y() * context.gravity.y()) / gravityOf(context) +
           std::abs(size.z() * context.gravity.z()) / gravityOf(context);
}

/// Distance of nearest neighbors in a body when it is made.
double spacingOf(const Section& body, const engine::Material& material) {
    if (body.has("spacing")) return body.number("spacing");
    return 2.0 * (body.has("particle_radius") ? body.number("particle_radius") : material.radius);
}

bool isOfMaterial(const Section& body, const engine::Material& material, bool isFirst) {
    return body.has("material") ? body.string("material") == material.name : isFirst;
}

}  // namespace

bool checkCompression(Section& material, BuildContext& context) {
    if (material.isGiven("depth") && !material.isGiven("compression")) {
        report(material, "depth", context, "depth does nothing without compression, which chooses b1 for that depth");
        return false;
    }
    if (!material.has("compression")) return false;
    if (gravityOf(context) == 0.0)
        report(material, "compression", context, "compression needs gravity: without it nothing is compressed");
    return material.isValid();
}

std::optional<engine::Column> columnOf(const Section& body, const engine::Material& material,
                                       const BuildContext& context) {
    if (!body.isValid() || !body.has("shape")) return std::nullopt;
    const std::string& shape = body.string("shape");
    if (shape == "points" || shape == "file") return std::nullopt;
    engine::Column column{.height = 0.0, .spacing = spacingOf(body, material), .gravity = gravityOf(context)};
    if (column.gravity == 0.0) return column;
    if (isFilledSolid(body)) {
        const Vec3 down = context.gravity / column.gravity;
        column.height = reachOf(body, down, context) + reachOf(body, -down, context);
    } else if (shape == "ball") {
        column.height = 2.0 * body.number("radius");
    } else if (shape == "box") {
        const engine::Packing packing{.spacing = column.spacing, .refinement = context.resolution};
        const Vec3 layers = engine::boxLayers(body.vector("minimum"), body.vector("maximum"), packing);
        column.height = heightOf(column.spacing / std::sqrt(2.0) * layers, context);
    } else {
        column.height = heightOf(column.spacing * body.vector("counts"), context);
        column.spacing *= kCubicSpacing;
    }
    return column;
}

engine::Column columnOf(std::span<const Vec3> positions, const engine::Material& material,
                        const BuildContext& context) {
    engine::Column column{.height = 0.0, .spacing = engine::restSpacing(material), .gravity = gravityOf(context)};
    if (positions.size() < 2 || column.gravity == 0.0) return column;
    const auto along = [&](const Vec3& position) { return position.dot(context.gravity) / column.gravity; };
    const auto [low, high] = std::ranges::minmax(positions, {}, along);
    column.height = along(high) - along(low) + column.spacing / std::sqrt(2.0);
    return column;
}

std::optional<engine::Column> columnFor(Section& section, const engine::Material& material,
                                        const std::vector<Section>& bodies, BuildContext& context) {
    const bool isFirst = section.path() == "material" || section.path() == "material[0]";
    std::optional<engine::Column> tallest;
    for (const Section& body : bodies) {
        if (!isOfMaterial(body, material, isFirst)) continue;
        const auto column = columnOf(body, material, context);
        if (column && column->height > (tallest ? tallest->height : 0.0)) tallest = column;
    }
    if (!tallest && !section.has("depth")) {
        if (!context.hasOmissions && std::ranges::all_of(bodies, &Section::isValid))
            report(section, "compression", context,
                   "compression needs a depth (meters): no body that is filled with a lattice tells it");
        section.markInvalid();
        return std::nullopt;
    }
    engine::Column column = tallest.value_or(
        engine::Column{.height = 0.0, .spacing = 2.0 * material.radius, .gravity = gravityOf(context)});
    if (section.has("depth")) column.height = section.number("depth");
    section.derive("depth", TypedValue::ofNumber(column.height));
    return column;
}

}  // namespace scenes
