// Emitters: nozzles that give birth to particles on a schedule. A birth that would overlap a particle waits a quarter
// of an interval, and again until its place is clear, and is counted. When it happens does not depend on the steps.
// Called once a step by the simulation; the whole state is a few counters.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Due times are sums of many intervals: what is this little apart is meant to be the same moment, s.
inline constexpr double kSameMoment = 1e-9;

/// What happens when a birth is due.
enum class Pick {
    all,    ///< every site gives birth, each on its own schedule
    random  ///< one site, drawn at random from the seed, gives birth
};

struct Emitter {
    std::vector<Vec3> sites;                                          ///< points of birth, m
    Vec3 velocity = Vec3::Zero();                                     ///< of a newborn, m/s
    double interval = 0.1;                                            ///< between births of a schedule, s
    double start = 0.0;                                               ///< first birth, s
    double until = std::numeric_limits<double>::infinity();           ///< no birth is due at or after this time, s
    std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< births in all
    Pick pick = Pick::all;
    double clearance = 1.0;  ///< least distance to any particle, in sums of radii; 0 lets births overlap
    double jitter = 0.0;     ///< random displacement across the velocity, up to this many radii
    std::uint32_t material = 0;
};

/// When the next birth of one schedule is due. An emitter has one per site, or a single one if it picks at random.
struct Schedule {
    double origin = 0.0;  ///< birth number k is due at origin + k intervals, s; a delay moves it
    double due = 0.0;     ///< s
    std::uint64_t births = 0;
    bool delayed = false;  ///< the birth that is due has found its place taken before
};

struct EmitterState {
    std::vector<Schedule> schedules;
    std::uint64_t births = 0;
    std::uint64_t refusals = 0;  ///< births that found their place taken when they were due; each is counted once
};

/// Two unit vectors that span a plane.
struct PlaneAxes {
    Vec3 first = Vec3::UnitX();
    Vec3 second = Vec3::UnitZ();
};

/// Axes of the plane across a direction of any length; the x and z axes where the direction is zero.
PlaneAxes axesAcross(const Vec3& direction);

/// Hexagonally packed sites of a disc nozzle, a center with whole rings around it.
/// Shape: at most radius from the center, neighbors spacing apart, in the plane across the direction.
std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// Schedules at their first birth.
EmitterState initialState(const Emitter& emitter);

/// Whether births can have led to a state: it is a finite one, on or behind schedule, and its counts agree.
bool isReachable(const Emitter& emitter, const EmitterState& state);

/// When the schedule's next emission is due if nothing delays it, s. Counting from the start keeps the due times of an
/// undisturbed schedule free of accumulated rounding.
double dueTime(const Emitter& emitter, const Schedule& schedule);

/// When the next birth is due or tried again, s; infinity when there will be none.
double nextEmission(const Emitter& emitter, const EmitterState& state);

}  // namespace engine
