// [[emitter]]: nozzles, their points of birth and their schedule.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

bool isDisc(const Section& section) {
    return section.has("shape") && section.text("shape") == "disc";
}

void checkPlaces(Section& section, BuildContext& context) {
    if (reportBoth(section, "position", "positions", context)) return;
    if (!section.isGiven("position") && !section.isGiven("positions")) reportMissing(section, "position", context);
}

void checkSchedule(Section& section, BuildContext& context) {
    if (!reportBoth(section, "interval", "rate", context) && !section.isGiven("interval") && !section.isGiven("rate"))
        reportMissing(section, "interval", context);
    if (section.has("start") && section.has("until") && section.number("until") <= section.number("start"))
        report(section, "until",
               fmt::format("until is {}, must be after start, {} (seconds)", section.canonical("until"),
                           section.canonical("start")),
               context);
}

/// The unit direction of a disc: its own, or that of the velocity.
std::optional<Vec3> discDirection(Section& section, BuildContext& context) {
    const bool own = section.isGiven("direction");
    if (!section.has(own ? "direction" : "velocity")) return std::nullopt;
    const auto direction = unitVector(section.vector(own ? "direction" : "velocity"));
    if (!direction && own) report(section, "direction", "direction is [0, 0, 0], must not be zero", context);
    if (!direction && !own)
        report(section, "direction", "direction is missing, a disc whose velocity is zero needs it", context);
    if (direction) section.deriveVector("direction", *direction);
    return direction;
}

/// Points of birth; empty, with the problem recorded, if there are too many.
std::vector<Vec3> discSitesOf(Section& section, const Vec3& direction, BuildContext& context) {
    const double across = 2.0 * section.number("radius") / section.number("spacing") + 1.0;
    if (across * across > context.limits.particles) {
        report(section, "spacing",
               fmt::format("the disc would have about {:.2g} points of birth, {}", across * across,
                           allowedText("particles", context.limits.particles)),
               context);
        return {};
    }
    return engine::discSites(section.vector("position"), direction, section.number("radius"),
                             section.number("spacing"));
}

std::vector<Vec3> sitesOf(Section& section, BuildContext& context) {
    if (isDisc(section)) {
        const auto direction = discDirection(section, context);
        return direction && section.isSound() ? discSitesOf(section, *direction, context) : std::vector<Vec3>{};
    }
    if (!section.isSound()) return {};
    return section.has("positions") ? section.vectors("positions") : std::vector<Vec3>{section.vector("position")};
}

/// Sets interval from rate or rate from interval: each of n schedules gives birth once an interval.
void completeSchedule(Section& section, double scheduleCount) {
    if (section.has("interval"))
        section.deriveNumber("rate", scheduleCount / section.number("interval"));
    else
        section.deriveNumber("interval", scheduleCount / section.number("rate"));
}

/// Births by the end of the scene have to be possible to hold.
void checkBirths(Section& section, BuildContext& context) {
    const double until = section.has("until") ? std::min(section.number("until"), context.duration) : context.duration;
    // Each schedule gives birth at its start, too.
    const double time = until - section.number("start");
    double births = time > 0.0 ? section.number("rate") * (time + section.number("interval")) : 0.0;
    if (section.has("count")) births = std::min(births, static_cast<double>(section.integer("count")));
    expect(section, section.isGiven("rate") ? "rate" : "interval", births, "the emitter would give birth to", context);
}

engine::Emitter emitterFrom(const Section& section, std::vector<Vec3> sites) {
    engine::Emitter emitter;
    emitter.sites = std::move(sites);
    emitter.velocity = section.vector("velocity");
    emitter.interval = section.number("interval");
    emitter.start = section.number("start");
    if (section.has("until")) emitter.until = section.number("until");
    if (section.has("count")) emitter.limit = static_cast<std::uint64_t>(section.integer("count"));
    emitter.pick = section.text("pick") == "random" ? engine::Pick::random : engine::Pick::all;
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
        checkPlaces(section, context);
        checkSchedule(section, context);
        if (isDisc(section)) section.deriveNumber("spacing", 2.0 * materials.list[material.value_or(0)].radius);
        std::vector<Vec3> sites = sitesOf(section, context);
        if (!section.isSound()) continue;
        completeSchedule(section, section.text("pick") == "random" ? 1.0 : static_cast<double>(sites.size()));
        checkBirths(section, context);
        emitters.push_back(emitterFrom(section, std::move(sites)));
        emitters.back().material = *material;
    }
    return emitters;
}

}  // namespace scenes
