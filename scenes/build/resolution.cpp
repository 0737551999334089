// The key resolution: the same scene of more and smaller particles. Everything in the tables of bodies and emitters
// that is tied to the size of a particle is changed here, before anything is built; materials follow in
// build_materials.cpp, and the lattices of boxes in engine/state/bodies.cpp, which keep their volume.
#include <algorithm>
#include <cmath>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

/// Multiplies a number that was given; a default follows by itself. Records a problem if the product is out of range.
void scale(Section& section, std::string_view name, double factor, BuildContext& context) {
    if (!section.isGiven(name) || !section.has(name)) return;
    const double scaled = section.number(name) * factor;
    const Range& range = findKey(section.table().name, name)->range;
    if (!(scaled >= range.low && scaled <= range.high))
        return report(section, name, context, "{} would be {:.7g} at resolution {}, must be {}", name, scaled,
                      formatNumber(context.resolution), rangeText(range));
    section.put(name, TypedValue::ofNumber(scaled), section.position(name), ValueOrigin::given);
}

void refineBody(Section& body, BuildContext& context) {
    if (!body.has("shape")) return;
    const double resolution = context.resolution;
    const std::string& shape = body.string("shape");
    if (shape == "points" || shape == "file")
        return report(
            body, shape == "file" ? "file" : "positions", context,
            "resolution is {}, but particles that are given one by one cannot be refined: use a box, a ball or "
            "another shape that is filled, or leave resolution at 1",
            formatNumber(resolution));
    scale(body, "spacing", 1.0 / resolution, context);
    scale(body, "particle_radius", 1.0 / resolution, context);
    scale(body, "particle_mass", 1.0 / (resolution * resolution * resolution), context);
    if (!body.has("counts")) return;
    engine::Vec3 counts = body.vector("counts");
    for (double& count : counts) count = std::max(1.0, std::round(count * resolution));
    body.put("counts", TypedValue::ofVector(counts), body.position("counts"), ValueOrigin::given);
}

/// The number of directions in which an emitter's points of emission fill a shape.
int dimensionsOf(const Section& emitter) {
    if (!emitter.has("shape")) return 0;
    const std::string& shape = emitter.string("shape");
    if (shape == "disc") return 2;
    if (shape == "ring" || shape == "line") return 1;
    if (shape != "box" || !emitter.has("size")) return 0;
    return static_cast<int>((emitter.vector("size").array() > 0.0).count());
}

void scaleCount(Section& section, std::string_view name, double factor) {
    if (!section.isGiven(name) || !section.has(name)) return;
    TypedValue count = section.typed(name);
    count.integer = std::max<std::int64_t>(1, std::llround(static_cast<double>(count.integer) * factor));
    count.canonical = fmt::format("{}", count.integer);
    section.put(name, std::move(count), section.position(name), ValueOrigin::given);
}

/// Refines an emitter. What is emitted in clusters, or from a shape with an area, keeps the mass that it emits per
/// second. Single points and lines cannot: a jet one particle wide becomes a thinner one.
void refineEmitter(Section& emitter, BuildContext& context) {
    const double resolution = context.resolution;
    const int dimensions = dimensionsOf(emitter);
    const bool isRandom = emitter.has("pick") && emitter.string("pick") == "random";
    const bool hasClusters = emitter.has("cluster") && emitter.integer("cluster") > 1;
    const bool isThin = dimensions < 2 && !hasClusters;
    const double particles = std::pow(resolution, isThin ? dimensions + 1 : 3);
    // Of the particles that one interval emits there are more by the points of emission or by the size of clusters.
    const double perInterval = hasClusters ? particles : isRandom ? 1.0 : std::pow(resolution, dimensions);
    if (!hasClusters) scale(emitter, "spacing", 1.0 / resolution, context);
    scale(emitter, "rate", particles, context);
    scale(emitter, "interval", perInterval / particles, context);
    scaleCount(emitter, "count", particles);
    scaleCount(emitter, "cluster", particles);
    if (isThin)
        context.warnings.add(emitter.position(),
                             fmt::format("at resolution {} the jets of points and lines of emission are thinner; use a "
                                         "disc or a box",
                                         formatNumber(resolution)));
}

}  // namespace

void applyResolution(Sections& sections, BuildContext& context) {
    if (context.resolution == 1.0) return;
    for (Section& body : sections.bodies) refineBody(body, context);
    for (Section& emitter : sections.emitters) refineEmitter(emitter, context);
    // Sound takes proportionally less time from one particle to the next.
    scale(sections.physics, "step", 1.0 / context.resolution, context);
}

}  // namespace scenes
