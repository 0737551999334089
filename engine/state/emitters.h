// Emitters: nozzles that add particles on a schedule. An emission that would overlap a particle is delayed and tried
// again until there is room; the delay shifts what follows, so that nothing comes in a burst. The times of emission do
// not depend on the time steps. The state of an emitter is a few counters. The particles of an emission are drawn by
// emission.h, and added by stepping/population.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/obstacles/motion.h"

namespace engine {

/// Times that differ by less than this count as the same moment, s. Due times are sums of many intervals and contain
/// rounding errors.
inline constexpr double kSameMoment = 1e-9;

/// Which sites of an emitter emit when a particle is due.
enum class Pick {
    all,        ///< every site, each on its own schedule, all at the same times
    staggered,  ///< every site, each on its own schedule, one after another, evenly over the interval
    random      ///< one site, drawn at random from the seed
};

struct Emitter {
    std::vector<Vec3> sites;       ///< where particles are emitted, m
    Vec3 velocity = Vec3::Zero();  ///< mean velocity of emitted particles, m/s
    /// How the emitter itself moves, from where its sites are given. Particles get the velocity of their site, too.
    Motion motion;
    double interval = 0.1;                                            ///< time between two emissions of a schedule, s
    double start = 0.0;                                               ///< time of the first emission, s
    double until = std::numeric_limits<double>::infinity();           ///< no emission is due at or after this time, s
    std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< largest number of particles emitted in all
    Pick pick = Pick::all;
    double clearance = 1.0;    ///< least distance of a new particle to others, in sums of radii; 0 allows overlaps
    double jitter = 0.0;       ///< largest random displacement across the velocity, in radii
    double spread = 0.0;       ///< 1 - cos(a), where a is the largest angle of a particle's velocity to the mean
    double speedSpread = 0.0;  ///< largest random change of the speed, as a share of it
    std::vector<Vec3> cluster = {Vec3::Zero()};  ///< the particles of one emission, around its site, m
    double leastDelay = 0.0;                     ///< an emission without room is tried again after at least this, s
    /// Emissions take place in groups, at the start and multiples of this time after it, s, or when they are due if it
    /// is 0. From when it is due to the end of its group a particle flies freely, so that sites that emit one after
    /// another end one time step together, not one each.
    double grouping = 0.0;
    std::uint32_t material = 0;  ///< of new particles; the solid one if it melts
    double temperature = 0.0;    ///< of new particles, K; only in a run with heat
};

/// One schedule of an emitter: when its next emission is due. An emitter has a schedule for each site, or a single
/// schedule if it picks sites at random.
struct Schedule {
    double origin = 0.0;       ///< emission k is due at origin + k intervals, s; delays change the origin
    double due = 0.0;          ///< s
    std::uint64_t births = 0;  ///< number of emissions so far
    bool delayed = false;      ///< whether the next emission has already been delayed
};

struct EmitterState {
    std::vector<Schedule> schedules;
    std::uint64_t births = 0;  ///< number of particles emitted so far
};

/// The state of an emitter before its first emission.
EmitterState initialState(const Emitter& emitter);

/// Whether emissions can have led to this state of an emitter: its times are finite and on schedule or delayed, and its
/// counts agree. Checked for states that come from a file.
bool isReachable(const Emitter& emitter, const EmitterState& state);

/// Time at which the next emission of a schedule is due if nothing delays it, s. It is computed from the number of
/// emissions so far, so that rounding errors do not accumulate.
double dueTime(const Emitter& emitter, const Schedule& schedule);

/// Whether an emission that is due at one time (s) takes place at or before another (s).
bool takesPlace(const Emitter& emitter, double due, double time);

/// Whether an emitter may still emit as many particles as one emission has.
bool hasLeft(const Emitter& emitter, const EmitterState& state);

/// Time after which an emission that has found no room is tried again, s.
double retryDelay(const Emitter& emitter);

/// Time at which the next emission of an emitter takes place or is tried again, s; infinity if there will be none.
double nextEmission(const Emitter& emitter, const EmitterState& state);

/// Where an emission takes place, and how fast its particles leave.
struct Launch {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
};

/// Where an emitter in motion emits what it would emit at this place with this velocity if it were at rest.
/// @param time  of the emission, s
Launch launchAt(const Emitter& emitter, double time, const Launch& atRest);

/// Number of particles that an emitter is to have emitted up to a time (s) if none has to wait for room.
std::uint64_t askedCount(const Emitter& emitter, double time);

/// Time in which free flight under gravity takes a particle a distance (m) away from its site, s; infinity if it never
/// gets there. Computed without functions of the math library that differ between machines.
/// @param velocity  m/s
/// @param gravity   m/s^2
double timeToMove(const Vec3& velocity, const Vec3& gravity, double distance);

/// Time in which an emission of the slowest particles is out of the way of the next one of its site, s; infinity if it
/// never is.
/// @param radius  of the emitted particles, m
double clearingTime(const Emitter& emitter, const Vec3& gravity, double radius);

/// Sets the shortest delay and the grouping of an emitter whose other members are complete.
void completeTimes(Emitter& emitter, const Vec3& gravity, double radius);

}  // namespace engine
