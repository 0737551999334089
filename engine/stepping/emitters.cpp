// Births on schedule. Every random number is a function of (seed, emitter, schedule, birth), so a few counters are the
// whole state and a resumed run draws what the uninterrupted one would have drawn.
#include "engine/stepping/emitters.h"

#include <cmath>

#include "engine/core/random.h"

namespace engine {
namespace {

/// Chosen: tries in an interval of a birth that has to wait. Each ends a step.
constexpr double kTries = 4.0;

/// Relative slack so that sites exactly on the rim of a disc are inside it.
constexpr double kRimSlack = 1.0 + 1e-9;

/// Two unit vectors across a direction of any length; the x and z axes where there is no direction.
struct Across {
    Vec3 first = Vec3::UnitX();
    Vec3 second = Vec3::UnitZ();
};

Across across(const Vec3& direction) {
    const double length = std::sqrt(squaredLength(direction));
    if (length == 0.0) return {};
    const Vec3 unit = direction / length;
    // The axis that lies least along the direction, so that the product is never short.
    const Vec3 axis = std::abs(unit.z()) < 0.7 ? Vec3::UnitZ() : Vec3::UnitX();
    Vec3 first = axis.cross(unit);
    first /= std::sqrt(squaredLength(first));
    return {first, unit.cross(first)};
}

/// What a random number is for: its stream within the emitter.
enum class Purpose : std::uint64_t { site = 0, jitterFirst = 1, jitterSecond = 2 };

/// One birth of one schedule.
struct Birth {
    std::uint64_t schedule = 0;
    std::uint64_t number = 0;
};

std::uint64_t drawBits(const BirthContext& context, const Birth& birth, Purpose purpose) {
    const std::uint64_t stream =
        (context.emitterIndex << 40) ^ (birth.schedule << 2) ^ static_cast<std::uint64_t>(purpose);
    return randomBits(context.seed, stream, birth.number);
}

Vec3 siteOf(const Emitter& emitter, const BirthContext& context, const Birth& birth) {
    if (emitter.pick == Pick::all) return emitter.sites[birth.schedule];
    return emitter.sites[drawBits(context, birth, Purpose::site) % emitter.sites.size()];
}

Vec3 jitterOf(const Emitter& emitter, const BirthContext& context, const Birth& birth) {
    if (emitter.jitter == 0.0) return Vec3::Zero();
    const Across plane = across(emitter.velocity);
    return symmetricUnit(drawBits(context, birth, Purpose::jitterFirst)) * plane.first +
           symmetricUnit(drawBits(context, birth, Purpose::jitterSecond)) * plane.second;
}

bool isClear(const Particles& particles, const LinkedCells& cells, const NewParticle& newborn, double clearance) {
    if (clearance == 0.0) return true;
    bool isClear = true;
    cells.forEachNear(newborn.position, [&](std::size_t p) {
        const double least = clearance * (particles.radius[p] + newborn.radius);
        if (squaredLength(particles.position[p] - newborn.position) < least * least) isClear = false;
    });
    return isClear;
}

NewParticle newbornOf(const Emitter& emitter, const BirthContext& context, const Material& material,
                      const Birth& birth) {
    NewParticle newborn;
    newborn.position =
        siteOf(emitter, context, birth) + emitter.jitter * material.radius * jitterOf(emitter, context, birth);
    newborn.velocity = emitter.velocity;
    newborn.radius = material.radius;
    newborn.mass = material.mass;
    newborn.birthTime = context.time;
    newborn.material = emitter.material;
    return newborn;
}

/// Of a schedule's next birth where nothing delays it, s. Counting from the start keeps the due times of an undisturbed
/// schedule free of accumulated rounding.
double dueTime(const Emitter& emitter, const Schedule& schedule) {
    return schedule.origin + static_cast<double>(schedule.births) * emitter.interval;
}

/// Where a newborn's free flight has taken it this long after its birth was due, in seconds.
void fly(NewParticle& newborn, const Vec3& gravity, double duration) {
    newborn.position += duration * newborn.velocity + 0.5 * duration * duration * gravity;
    newborn.velocity += duration * gravity;
    newborn.birthTime -= duration;
}

}  // namespace

std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing) {
    const Across plane = across(direction);
    const double rowHeight = spacing * std::sqrt(0.75);
    const auto rows = static_cast<int>(std::floor(radius * kRimSlack / rowHeight));
    std::vector<Vec3> sites;
    for (int row = -rows; row <= rows; ++row) {
        const double across2 = row * rowHeight;
        const double shift = row % 2 == 0 ? 0.0 : 0.5 * spacing;
        const auto columns = static_cast<int>(std::floor(radius * kRimSlack / spacing)) + 1;
        for (int column = -columns; column <= columns; ++column) {
            const double across1 = column * spacing + shift;
            if (across1 * across1 + across2 * across2 > radius * radius * kRimSlack) continue;
            sites.push_back(center + across1 * plane.first + across2 * plane.second);
        }
    }
    return sites;
}

EmitterState initialState(const Emitter& emitter) {
    EmitterState state;
    state.schedules.resize(emitter.pick == Pick::all ? emitter.sites.size() : 1);
    for (Schedule& schedule : state.schedules) schedule.origin = schedule.due = emitter.start;
    return state;
}

bool isReachable(const Emitter& emitter, const EmitterState& state) {
    std::uint64_t births = 0;
    for (const Schedule& schedule : state.schedules) {
        const double undisturbed = dueTime(emitter, schedule);
        if (!std::isfinite(schedule.due) || schedule.origin < emitter.start - kSameMoment) return false;
        if (schedule.delayed ? schedule.due <= undisturbed : schedule.due != undisturbed) return false;
        births += schedule.births;
    }
    return births == state.births && births <= emitter.limit;
}

double nextBirth(const Emitter& emitter, const EmitterState& state) {
    double next = std::numeric_limits<double>::infinity();
    if (state.births >= emitter.limit) return next;
    for (const Schedule& schedule : state.schedules)
        if (schedule.due < emitter.until - kSameMoment) next = std::min(next, schedule.due);
    return next;
}

double birthReach(const Emitter& emitter, double largestRadius) {
    return emitter.clearance * 2.0 * largestRadius;
}

std::size_t emit(const Emitter& emitter, EmitterState& state, const BirthContext& context, const Material& material,
                 Particles& particles, LinkedCells& cells) {
    std::size_t born = 0;
    for (std::size_t s = 0; s < state.schedules.size(); ++s) {
        Schedule& schedule = state.schedules[s];
        while (schedule.due <= context.time + kSameMoment && schedule.due < emitter.until - kSameMoment &&
               state.births < emitter.limit) {
            const Birth birth{s, schedule.births};
            NewParticle newborn = newbornOf(emitter, context, material, birth);
            fly(newborn, context.gravity, std::max(0.0, context.time - schedule.due));
            if (!isClear(particles, cells, newborn, emitter.clearance)) {
                if (!schedule.delayed) ++state.refusals;
                schedule.delayed = true;
                schedule.due += emitter.interval / kTries;
                continue;
            }
            append(particles, newborn);
            cells.add(newborn.position);
            // A delay shifts the schedule, or its births would come in a burst.
            ++schedule.births;
            if (schedule.delayed)
                schedule.origin = schedule.due - static_cast<double>(schedule.births - 1) * emitter.interval;
            schedule.due = dueTime(emitter, schedule);
            schedule.delayed = false;
            ++state.births;
            ++born;
        }
    }
    return born;
}

}  // namespace engine
