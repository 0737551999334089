// Schedules of emitters.
#include "engine/state/emitters.h"

#include <algorithm>
#include <cmath>

namespace engine {
namespace {

/// How many times per interval an emission that has found no room is tried again. Chosen: where each try ends a time
/// step, few are wanted; grouped emissions are tried between steps.
constexpr double kTriesPerInterval = 4.0;
constexpr double kGroupedTriesPerInterval = 16.0;

/// A delayed emission is not tried more often than this while the one before moves out of the way. Chosen: the rate
/// falls by half of a sixteenth on average.
constexpr double kTriesWhileClearing = 16.0;

/// How far a particle may fly freely between two groups of emissions, in radii. Chosen: the distance of two
/// layers of a dense jet and a little more, so that a jet ends one step for each layer.
constexpr double kGroupedFlight = 2.2;

/// Share of the grouping by which an emission may be due after the end of a group and still belong to it, for rounding.
constexpr double kGroupingSlack = 1e-6;

/// Time of the first emission of a schedule, s. Schedules that are staggered begin one after another.
double firstDue(const Emitter& emitter, std::size_t schedule) {
    if (emitter.pick != Pick::staggered) return emitter.start;
    const double share = static_cast<double>(schedule) / static_cast<double>(emitter.sites.size());
    return emitter.start + share * emitter.interval;
}

std::size_t scheduleCount(const Emitter& emitter) {
    return emitter.pick == Pick::random ? 1 : emitter.sites.size();
}

/// Time at which an emission that is due at a time (s) takes place, s.
double emissionTime(const Emitter& emitter, double due) {
    if (emitter.grouping == 0.0) return due;
    return emitter.start + std::ceil((due - emitter.start) / emitter.grouping - kGroupingSlack) * emitter.grouping;
}

bool isBeforeEnd(const Emitter& emitter, double due) {
    return due < emitter.until - kSameMoment;
}

/// An upper bound on the speed of an emitter's sites, m/s.
double carriedSpeed(const Emitter& emitter) {
    if (emitter.motion.isAtRest()) return 0.0;
    double extentSq = 0.0;
    for (const Vec3& site : emitter.sites) extentSq = std::max(extentSq, squaredLength(site - emitter.motion.pivot));
    return fastestBetween(emitter.motion, 0.0, std::numeric_limits<double>::infinity(), std::sqrt(extentSq));
}

/// Number of emissions of a schedule that take place up to a time (s) if none is delayed.
std::uint64_t askedCount(const Emitter& emitter, double first, double time) {
    const auto isAsked = [&](double k) {
        const double due = first + k * emitter.interval;
        return takesPlace(emitter, due, time) && isBeforeEnd(emitter, due);
    };
    // The quotient may be off by one for rounding or the grouping.
    double count = std::max(0.0, std::floor((std::min(time, emitter.until) - first) / emitter.interval));
    while (count > 0.0 && !isAsked(count - 1.0)) count -= 1.0;
    while (isAsked(count)) count += 1.0;
    return static_cast<std::uint64_t>(count);
}

}  // namespace

double dueTime(const Emitter& emitter, const Schedule& schedule) {
    return schedule.origin + static_cast<double>(schedule.births) * emitter.interval;
}

bool takesPlace(const Emitter& emitter, double due, double time) {
    return emissionTime(emitter, due) <= time + kSameMoment;
}

bool hasLeft(const Emitter& emitter, const EmitterState& state) {
    return state.births < emitter.limit && emitter.limit - state.births >= emitter.cluster.size();
}

double retryDelay(const Emitter& emitter) {
    const double tries = emitter.grouping > 0.0 ? kGroupedTriesPerInterval : kTriesPerInterval;
    return std::max(emitter.interval / tries, emitter.leastDelay);
}

EmitterState initialState(const Emitter& emitter) {
    EmitterState state;
    state.schedules.resize(scheduleCount(emitter));
    for (std::size_t s = 0; s < state.schedules.size(); ++s)
        state.schedules[s].origin = state.schedules[s].due = firstDue(emitter, s);
    return state;
}

bool isReachable(const Emitter& emitter, const EmitterState& state) {
    std::uint64_t births = 0;
    for (std::size_t s = 0; s < state.schedules.size(); ++s) {
        const Schedule& schedule = state.schedules[s];
        const double undisturbed = dueTime(emitter, schedule);
        if (!std::isfinite(schedule.due) || schedule.origin < firstDue(emitter, s) - kSameMoment) return false;
        if (schedule.delayed ? schedule.due <= undisturbed : schedule.due != undisturbed) return false;
        births += schedule.births;
    }
    return births * emitter.cluster.size() == state.births && state.births <= emitter.limit;
}

double nextEmission(const Emitter& emitter, const EmitterState& state) {
    double next = std::numeric_limits<double>::infinity();
    if (!hasLeft(emitter, state)) return next;
    for (const Schedule& schedule : state.schedules)
        if (isBeforeEnd(emitter, schedule.due)) next = std::min(next, emissionTime(emitter, schedule.due));
    return next;
}

Launch launchAt(const Emitter& emitter, double time, const Launch& atRest) {
    if (emitter.motion.isIdentity()) return atRest;
    const Pose pose = poseAt(emitter.motion, time);
    const Vec3 position = pose.toScene(atRest.position);
    return {position, pose.rotation * atRest.velocity + pose.velocityAt(position)};
}

std::uint64_t askedCount(const Emitter& emitter, double time) {
    std::uint64_t emissions = 0;
    for (std::size_t s = 0; s < scheduleCount(emitter); ++s)
        emissions += askedCount(emitter, firstDue(emitter, s), time);
    const std::uint64_t size = emitter.cluster.size();
    return size * std::min(emissions, emitter.limit / size);
}

double timeToMove(const Vec3& velocity, const Vec3& gravity, double distance) {
    const double speed = std::sqrt(squaredLength(velocity));
    const double fall = std::sqrt(squaredLength(gravity));
    const double never = std::numeric_limits<double>::infinity();
    const double straight = speed > 0.0 ? distance / speed : never;
    if (fall == 0.0 || distance == 0.0) return straight;
    const double scale = std::min(straight, std::sqrt(2.0 * distance / fall));
    const auto isAway = [&](double t) {
        return squaredLength(t * velocity + 0.5 * t * t * gravity) >= distance * distance;
    };
    // The particle has not gone the distance at half the scale. A throw that returns before it has gone the distance is
    // that far below its site after 4.8 times the scale at most: (1 + sqrt 2) v / g, where v^2 = 2 g times the
    // distance.
    constexpr double kMostScales = 8.0;
    double late = 0.5 * scale;
    while (!isAway(late) && late < kMostScales * scale) late += 0.125 * scale;
    double early = late - 0.125 * scale;
    for (double middle = 0.5 * (early + late); middle > early && middle < late; middle = 0.5 * (early + late))
        (isAway(middle) ? late : early) = middle;
    return late;
}

double clearingTime(const Emitter& emitter, const Vec3& gravity, double radius) {
    double outermost = 0.0;
    for (const Vec3& position : emitter.cluster) outermost = std::max(outermost, squaredLength(position));
    const double distance = 2.0 * std::sqrt(outermost) + 2.0 * emitter.clearance * radius;
    return timeToMove((1.0 - emitter.speedSpread) * emitter.velocity, gravity, distance);
}

void completeTimes(Emitter& emitter, const Vec3& gravity, double radius) {
    emitter.leastDelay = 0.0;
    emitter.grouping = 0.0;
    if (emitter.pick == Pick::all) return;
    const double clearing = clearingTime(emitter, gravity, radius);
    if (std::isfinite(clearing)) emitter.leastDelay = clearing / kTriesWhileClearing;
    if (emitter.pick != Pick::staggered) return;
    const double carried = carriedSpeed(emitter);
    const double speed = std::sqrt(squaredLength(emitter.velocity));
    double flight = timeToMove(emitter.velocity, gravity, kGroupedFlight * radius);
    if (carried > 0.0) flight = std::min(flight, kGroupedFlight * radius / (speed + carried));
    const double groups = std::ceil(emitter.interval / flight);
    if (groups < static_cast<double>(emitter.sites.size()) || groups == 1.0)
        emitter.grouping = emitter.interval / std::max(1.0, groups);
}

}  // namespace engine
