// Makes the emitters of the simulation, with their points of emission and times of emission, from the [[emitter]]
// tables of a scene.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/run/fitting_rate.h"
#include "engine/state/emitter_sites.h"
#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

bool isOfShape(const Section& section, std::string_view shape) {
    return section.has("shape") && section.string("shape") == shape;
}

/// Whether the emitter's points of emission lie in a plane across a direction.
bool isFacing(const Section& section) {
    return isOfShape(section, "disc") || isOfShape(section, "ring");
}

void checkPositions(Section& section, BuildContext& context) {
    if (settleConflict(section, "position", "positions", context)) return;
    if (!section.isGiven("position") && !section.isGiven("positions")) reportMissing(section, "position", context);
}

void checkSchedule(Section& section, BuildContext& context) {
    settleConflict(section, "interval", "rate", context);
    if (section.has("start") && section.has("until") && section.number("until") <= section.number("start"))
        report(section, "until", context, "until is {}, must be after start, {} (seconds)", section.canonical("until"),
               section.canonical("start"));
    if (section.has("count") && section.has("cluster") && section.integer("count") < section.integer("cluster"))
        report(section, "count", context, "count is {}, must be at least that of one cluster, {}",
               section.canonical("count"), section.canonical("cluster"));
}

/// The unit normal of a disc or ring of emission: the key direction, scaled to length 1, or without it the direction of
/// the velocity.
std::optional<Vec3> normalOf(Section& section, BuildContext& context) {
    if (section.has("direction")) return directionFrom(section, "direction", context);
    if (section.isGiven("direction") || !section.has("velocity")) return std::nullopt;
    const auto normal = unitVector(section.vector("velocity"));
    if (!normal)
        report(section, "direction", context, "direction is missing, a {} whose velocity is zero needs it",
               section.string("shape"));
    if (normal) section.derive("direction", TypedValue::ofVector(*normal));
    return normal;
}

/// At another resolution, gives a disc the area that its points of emission had at resolution 1, each of which stands
/// for its cell of the hexagonal lattice, and an interval with which it emits the same mass per second. The interval
/// has already been divided by the resolution, which is right if there are as many more points as there is finer area.
void refineDisc(Section& section, BuildContext& context) {
    if (context.resolution == 1.0 || !section.isValid()) return;
    const double spacing = section.number("spacing");
    const double coarse = spacing * context.resolution;
    const double radius = section.number("radius");
    if (std::pow(2.0 * radius / std::min(spacing, coarse) + 1.0, 2.0) > context.limits.particles) return;
    const auto countOf = [](double within, double apart) {
        return static_cast<double>(engine::discSites(Vec3::Zero(), Vec3::UnitY(), within, apart).size());
    };
    const double coarseCount = countOf(radius, coarse);
    const double refined = coarse * std::sqrt(coarseCount * std::sqrt(0.75) / std::numbers::pi);
    const double wanted = coarseCount * context.resolution * context.resolution;
    section.put("radius", TypedValue::ofNumber(refined), section.position("radius"), ValueOrigin::given);
    if (!section.isGiven("interval") || section.string("pick") == "random") return;
    section.put("interval", TypedValue::ofNumber(section.number("interval") * countOf(refined, spacing) / wanted),
                section.position("interval"), ValueOrigin::given);
}

/// About how many points of emission the shape would have, never less than the number that it has.
double mostSites(const Section& section) {
    const auto pointsAlong = [&](double length) { return length / section.number("spacing") + 1.0; };
    if (isOfShape(section, "disc")) return std::pow(pointsAlong(2.0 * section.number("radius")), 2.0);
    if (isOfShape(section, "ring")) return pointsAlong(2.0 * std::numbers::pi * section.number("radius"));
    const Vec3 size =
        isOfShape(section, "line") ? Vec3(section.vector("end") - section.vector("position")) : section.vector("size");
    if (isOfShape(section, "line")) return pointsAlong(size.stableNorm());
    return 1.5 * pointsAlong(size.x()) * pointsAlong(size.y()) * pointsAlong(size.z());
}

/// Points of emission that fill a shape; none, with the problem recorded, if there would be too many.
std::vector<Vec3> filledSites(Section& section, const Vec3& normal, BuildContext& context) {
    const double most = mostSites(section);
    if (most > context.limits.particles) {
        report(section, "spacing", context, "the {} would have about {:.2g} points of emission, {}",
               section.string("shape"), most, allowedText("particles", context.limits.particles));
        return {};
    }
    const Vec3& position = section.vector("position");
    const double spacing = section.number("spacing");
    if (isOfShape(section, "disc")) return engine::discSites(position, normal, section.number("radius"), spacing);
    if (isOfShape(section, "ring")) return engine::ringSites(position, normal, section.number("radius"), spacing);
    if (isOfShape(section, "line")) return engine::lineSites(position, section.vector("end"), spacing);
    return engine::boxSites(position, section.vector("size"), spacing);
}

std::vector<Vec3> sitesOf(Section& section, BuildContext& context) {
    std::optional<Vec3> normal = Vec3::UnitY();
    if (isFacing(section)) normal = normalOf(section, context);
    if (!normal || !section.isValid()) return {};
    if (!isOfShape(section, "point")) return filledSites(section, *normal, context);
    return section.has("positions") ? section.vectors("positions") : std::vector<Vec3>{section.vector("position")};
}

/// Derives what depends on the particle's radius (m), the jitter and the size of a cluster.
void deriveSizes(Section& section, double radius) {
    double diameter = 2.0 * radius;
    if (section.has("cluster"))
        for (const Vec3& offset :
             engine::clusterPositions(static_cast<std::size_t>(section.integer("cluster")), 2.0 * radius))
            diameter = std::max(diameter, 2.0 * (radius + std::sqrt(engine::squaredLength(offset))));
    if (!isOfShape(section, "point")) section.derive("spacing", TypedValue::ofNumber(diameter));
    // Neighbors that are displaced towards each other, each in two directions, come closer by this share.
    constexpr double kLeastClearance = 0.8;  // chosen: what any substance bears without being shot apart
    if (section.has("jitter"))
        section.derive("clearance", TypedValue::ofNumber(std::max(
                                        kLeastClearance, 1.0 - std::numbers::sqrt2 * section.number("jitter"))));
}

/// Number of particles that all schedules together emit per interval. An emitter has one schedule for each point of
/// emission, or a single one if it picks points at random.
double particlesPerInterval(const engine::Emitter& emitter) {
    return static_cast<double>(engine::initialState(emitter).schedules.size() * emitter.cluster.size());
}

/// The shortest interval at which an emitter finds room for its particles, s; nothing, with the problem recorded, if
/// there is no such interval.
std::optional<double> densestInterval(Section& section, engine::Emitter emitter, const Materials& materials,
                                      BuildContext& context) {
    constexpr double kMargin = 1.001;  // chosen: far above rounding errors
    constexpr double kEnough = 0.99;   // share of the emissions that find room; chosen
    constexpr int kMostRounds = 4;
    const double radius = materials.list[emitter.material].radius;
    const double clearing = engine::clearingTime(emitter, context.gravity, radius);
    if (!std::isfinite(clearing) || clearing <= 0.0) {
        report(section, "rate", context, "rate is missing, an emitter {} needs it (per second)",
               clearing > 0.0 ? "whose particles do not move away" : "without clearance");
        return std::nullopt;
    }
    engine::Setup setup;
    setup.materials = materials.list;
    setup.gravity = context.gravity;
    setup.seed = context.seed;
    // The particles of a point follow one another at the distance at which they touch, even if their clearance allows
    // less: nearer, they would push each other apart, and roundings would decide whether one finds room.
    engine::Emitter touching = emitter;
    touching.clearance = std::max(1.0, emitter.clearance);
    emitter.interval = kMargin * engine::clearingTime(touching, context.gravity, radius);
    if (emitter.pick == engine::Pick::random) emitter.interval /= static_cast<double>(emitter.sites.size());
    for (int round = 0; round < kMostRounds; ++round) {
        engine::completeTimes(emitter, context.gravity, radius);
        setup.emitters = {emitter};
        const double share = engine::fittingShare(setup, 0);
        if (share >= kEnough) break;
        emitter.interval /= std::max(share, 1.0 / static_cast<double>(emitter.sites.size()));
    }
    return emitter.interval;
}

/// Completes rate and interval: one from the other, or both from what fits.
void completeSchedule(Section& section, engine::Emitter& emitter, const Materials& materials, BuildContext& context) {
    const double particles = particlesPerInterval(emitter);
    if (section.has("rate")) {
        section.derive("interval", TypedValue::ofNumber(particles / section.number("rate")));
    } else if (!section.has("interval")) {
        const auto densest = densestInterval(section, emitter, materials, context);
        if (!densest) return;
        section.derive("interval", TypedValue::ofNumber(*densest));
    }
    emitter.interval = section.number("interval");
    section.derive("rate", TypedValue::ofNumber(particles / emitter.interval));
    engine::completeTimes(emitter, context.gravity, materials.list[emitter.material].radius);
}

/// Checks that the particles emitted by the end of the scene are not too many.
void checkEmissionCount(Section& section, BuildContext& context) {
    const double until = section.has("until") ? std::min(section.number("until"), context.duration) : context.duration;
    // Each schedule emits its first particle at the start, not after one interval, which adds one interval to the time.
    const double time = until - section.number("start");
    double count = time > 0.0 ? section.number("rate") * (time + section.number("interval")) : 0.0;
    if (section.has("count")) count = std::min(count, static_cast<double>(section.integer("count")));
    addExpectedParticles(section, section.isGiven("interval") ? "interval" : "rate", count, "the emitter would emit",
                         context);
}

/// The emitter without its times of emission.
engine::Emitter emitterFrom(const Section& section, std::vector<Vec3> sites, std::uint32_t material, double radius) {
    engine::Emitter emitter;
    emitter.material = material;
    emitter.sites = std::move(sites);
    emitter.velocity = section.vector("velocity");
    emitter.start = section.number("start");
    if (section.has("until")) emitter.until = section.number("until");
    if (section.has("count")) emitter.limit = static_cast<std::uint64_t>(section.integer("count"));
    const std::string& pick = section.string("pick");
    emitter.pick = pick == "random" ? engine::Pick::random
                   : pick == "all"  ? engine::Pick::all
                                    : engine::Pick::staggered;
    if (emitter.pick == engine::Pick::staggered) emitter.sites = engine::takingTurns(emitter.sites);
    emitter.clearance = section.number("clearance");
    emitter.jitter = section.number("jitter");
    emitter.spread = engine::oneMinusCosine(section.number("spread"));
    emitter.speedSpread = section.number("speed_spread");
    emitter.cluster = engine::clusterPositions(static_cast<std::size_t>(section.integer("cluster")), 2.0 * radius);
    return emitter;
}

}  // namespace

std::vector<engine::Emitter> buildEmitters(std::vector<Section>& sections, const Materials& materials,
                                           BuildContext& context) {
    std::vector<engine::Emitter> emitters;
    for (Section& section : sections) {
        const auto material = materialOf(section, materials, context);
        const double radius = materials.list[material.value_or(0)].radius;
        checkPositions(section, context);
        checkSchedule(section, context);
        deriveSizes(section, radius);
        if (isOfShape(section, "disc")) refineDisc(section, context);
        std::vector<Vec3> sites = sitesOf(section, context);
        checkWithinWorld(section, section.has("positions") ? "positions" : "position", sites, context);
        if (!section.isValid()) continue;
        const Vec3 pivot = section.has("positions") ? sites.front() : section.vector("position");
        engine::Emitter emitter = emitterFrom(section, std::move(sites), *material, radius);
        emitter.motion = motionFrom(section, "travel", pivot, context);
        completeSchedule(section, emitter, materials, context);
        if (!section.isValid()) continue;
        checkEmissionCount(section, context);
        emitters.push_back(std::move(emitter));
    }
    return emitters;
}

}  // namespace scenes
