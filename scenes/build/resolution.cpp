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
            "a grid, or leave resolution at 1",
            formatNumber(resolution));
    scale(body, "spacing", 1.0 / resolution, context);
    scale(body, "particle_radius", 1.0 / resolution, context);
    scale(body, "particle_mass", 1.0 / (resolution * resolution * resolution), context);
    if (!body.has("counts")) return;
    engine::Vec3 counts = body.vector("counts");
    for (double& count : counts) count = std::max(1.0, std::round(count * resolution));
    body.put("counts", TypedValue::ofVector(counts), body.position("counts"), ValueOrigin::given);
}

/// Refines an emitter. A disc keeps the mass that it emits per second. Single points of emission cannot: a jet one
/// particle wide becomes a thinner one.
void refineEmitter(Section& emitter, BuildContext& context) {
    const double resolution = context.resolution;
    const bool isDisc = emitter.has("shape") && emitter.string("shape") == "disc";
    const bool isRandom = emitter.has("pick") && emitter.string("pick") == "random";
    const double volume = isDisc ? resolution * resolution * resolution : resolution;
    scale(emitter, "spacing", 1.0 / resolution, context);
    scale(emitter, "rate", volume, context);
    scale(emitter, "interval", 1.0 / (isRandom ? volume : resolution), context);
    if (emitter.has("count")) {
        TypedValue count = emitter.typed("count");
        count.integer = std::max<std::int64_t>(1, std::llround(static_cast<double>(count.integer) * volume));
        count.canonical = fmt::format("{}", count.integer);
        emitter.put("count", std::move(count), emitter.position("count"), ValueOrigin::given);
    }
    if (!isDisc)
        context.warnings.add(
            emitter.position(),
            fmt::format("at resolution {} the jets of single points of emission are thinner; use shape = \"disc\"",
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
