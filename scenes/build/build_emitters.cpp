// Makes the emitters of the simulation, with their points of emission and times of emission, from the [[emitter]]
// tables of a scene.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

bool isDisc(const Section& section) {
    return section.has("shape") && section.string("shape") == "disc";
}

void checkPositions(Section& section, BuildContext& context) {
    if (reportConflict(section, "position", "positions", context)) return;
    if (!section.isGiven("position") && !section.isGiven("positions")) reportMissing(section, "position", context);
}

void checkSchedule(Section& section, BuildContext& context) {
    if (!reportConflict(section, "interval", "rate", context) && !section.isGiven("interval") &&
        !section.isGiven("rate"))
        reportMissing(section, "interval", context);
    if (section.has("start") && section.has("until") && section.number("until") <= section.number("start"))
        report(section, "until", context, "until is {}, must be after start, {} (seconds)", section.canonical("until"),
               section.canonical("start"));
}

/// The unit normal of a disc of emission: the key direction, scaled to length 1, or without it the direction of the
/// velocity.
std::optional<Vec3> discNormal(Section& section, BuildContext& context) {
    if (section.has("direction")) return directionFrom(section, "direction", context);
    if (section.isGiven("direction") || !section.has("velocity")) return std::nullopt;
    const auto normal = unitVector(section.vector("velocity"));
    if (!normal) report(section, "direction", context, "direction is missing, a disc whose velocity is zero needs it");
    if (normal) section.derive("direction", TypedValue::ofVector(*normal));
    return normal;
}

double sitesAcross(double radius, double spacing) {
    return 2.0 * radius / spacing + 1.0;
}

/// At another resolution, gives a disc the area that its points of emission had at resolution 1, each of which stands
/// for its cell of the hexagonal lattice, and an interval with which it emits the same mass per second. The interval
/// has already been divided by the resolution, which is right if there are as many more points as there is finer area.
void refineDisc(Section& section, BuildContext& context) {
    if (context.resolution == 1.0 || !section.isValid()) return;
    const double spacing = section.number("spacing");
    const double coarse = spacing * context.resolution;
    const double radius = section.number("radius");
    if (std::pow(sitesAcross(radius, std::min(spacing, coarse)), 2.0) > context.limits.particles) return;
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

/// Points of emission that fill a disc; none, with the problem recorded, if there would be too many.
std::vector<Vec3> discSitesOf(Section& section, const Vec3& normal, BuildContext& context) {
    const double across = sitesAcross(section.number("radius"), section.number("spacing"));
    if (across * across > context.limits.particles) {
        report(section, "spacing", context, "the disc would have about {:.2g} points of emission, {}", across * across,
               allowedText("particles", context.limits.particles));
        return {};
    }
    return engine::discSites(section.vector("position"), normal, section.number("radius"), section.number("spacing"));
}

std::vector<Vec3> sitesOf(Section& section, BuildContext& context) {
    if (isDisc(section)) {
        const auto normal = discNormal(section, context);
        return normal && section.isValid() ? discSitesOf(section, *normal, context) : std::vector<Vec3>{};
    }
    if (!section.isValid()) return {};
    return section.has("positions") ? section.vectors("positions") : std::vector<Vec3>{section.vector("position")};
}

/// Derives the rate of an emitter from its interval, or the interval from the rate. An emitter has one schedule for
/// each point of emission, or a single one if it picks points at random; each schedule emits one particle per interval.
void completeSchedule(Section& section, double scheduleCount) {
    if (section.has("interval"))
        section.derive("rate", TypedValue::ofNumber(scheduleCount / section.number("interval")));
    else
        section.derive("interval", TypedValue::ofNumber(scheduleCount / section.number("rate")));
}

/// Checks that the particles emitted by the end of the scene are not too many.
void checkEmissionCount(Section& section, BuildContext& context) {
    const double until = section.has("until") ? std::min(section.number("until"), context.duration) : context.duration;
    // Each schedule emits its first particle at the start, not after one interval, which adds one interval to the time.
    const double time = until - section.number("start");
    double count = time > 0.0 ? section.number("rate") * (time + section.number("interval")) : 0.0;
    if (section.has("count")) count = std::min(count, static_cast<double>(section.integer("count")));
    addExpectedParticles(section, section.isGiven("rate") ? "rate" : "interval", count, "the emitter would emit",
                         context);
}

engine::Emitter emitterFrom(const Section& section, std::vector<Vec3> sites) {
    engine::Emitter emitter;
    emitter.sites = std::move(sites);
    emitter.velocity = section.vector("velocity");
    emitter.interval = section.number("interval");
    emitter.start = section.number("start");
    if (section.has("until")) emitter.until = section.number("until");
    if (section.has("count")) emitter.limit = static_cast<std::uint64_t>(section.integer("count"));
    emitter.pick = section.string("pick") == "random" ? engine::Pick::random : engine::Pick::all;
    emitter.clearance = section.number("clearance");
    emitter.jitter = section.number("jitter");
    return emitter;
}

}  // namespace

std::vector<engine::Emitter> buildEmitters(std::vector<Section>& sections, const Materials& materials,
                                           BuildContext& context) {
    std::vector<engine::Emitter> emitters;
    for (Section& section : sections) {
        const auto material = materialOf(section, materials, context);
        checkPositions(section, context);
        checkSchedule(section, context);
        if (isDisc(section)) {
            section.derive("spacing", TypedValue::ofNumber(2.0 * materials.list[material.value_or(0)].radius));
            refineDisc(section, context);
        }
        std::vector<Vec3> sites = sitesOf(section, context);
        checkWithinWorld(section, section.has("positions") ? "positions" : "position", sites, context);
        if (!section.isValid()) continue;
        completeSchedule(section, section.string("pick") == "random" ? 1.0 : static_cast<double>(sites.size()));
        checkEmissionCount(section, context);
        emitters.push_back(emitterFrom(section, std::move(sites)));
        emitters.back().material = *material;
    }
    return emitters;
}

}  // namespace scenes
