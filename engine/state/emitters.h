// Emitters: nozzles that add particles on a schedule. An emission that would overlap a particle is delayed by a quarter
// of an interval, repeatedly until there is room, and is counted once as refused. The times of emission do not depend
// on the time steps. The state of an emitter is a few counters. Particles are emitted by stepping/population.h.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Times that differ by less than this count as the same moment, s. Due times are sums of many intervals and contain
/// rounding errors.
inline constexpr double kSameMoment = 1e-9;

/// Which sites of an emitter emit when a particle is due.
enum class Pick {
    all,    ///< every site, each on its own schedule
    random  ///< one site, drawn at random from the seed
};

struct Emitter {
    std::vector<Vec3> sites;                                          ///< where particles are emitted, m
    Vec3 velocity = Vec3::Zero();                                     ///< velocity of an emitted particle, m/s
    double interval = 0.1;                                            ///< time between two emissions of a schedule, s
    double start = 0.0;                                               ///< time of the first emission, s
    double until = std::numeric_limits<double>::infinity();           ///< no emission is due at or after this time, s
    std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< largest number of particles emitted in all
    Pick pick = Pick::all;
    double clearance = 1.0;  ///< least distance of a new particle to others, in sums of radii; 0 allows overlaps
    double jitter = 0.0;     ///< largest random displacement across the velocity, in radii
    std::uint32_t material = 0;
};

/// One schedule of an emitter: when its next particle is due. An emitter has a schedule for each site, or a single
/// schedule if it picks sites at random.
struct Schedule {
    double origin = 0.0;  ///< emission k is due at origin + k intervals, s; delays change the origin
    double due = 0.0;     ///< s
    std::uint64_t births = 0;
    bool delayed = false;  ///< whether the next emission has already been delayed
};

struct EmitterState {
    std::vector<Schedule> schedules;
    std::uint64_t births = 0;
    std::uint64_t refusals = 0;  ///< number of emissions that had to wait for room; each counts once
};

/// Two perpendicular unit vectors that span a plane.
struct PlaneAxes {
    Vec3 first = Vec3::UnitX();
    Vec3 second = Vec3::UnitZ();
};

/// Two axes of the plane that is perpendicular to a direction vector of any length; the x and z axes if the vector is
/// zero.
PlaneAxes axesAcross(const Vec3& direction);

/// Hexagonally packed sites of a disc-shaped nozzle around a center (m), in the plane perpendicular to the direction.
/// @param radius   largest distance from the center, m
/// @param spacing  distance between neighboring sites, m
std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// The state of an emitter before its first emission.
EmitterState initialState(const Emitter& emitter);

/// Whether emissions can have led to this state of an emitter: its times are finite and on schedule or delayed, and its
/// counts agree. Checked for states that come from a file.
bool isReachable(const Emitter& emitter, const EmitterState& state);

/// Time at which the next emission of a schedule is due if nothing delays it, s. It is computed from the number of
/// emissions so far, so that rounding errors do not accumulate.
double dueTime(const Emitter& emitter, const Schedule& schedule);

/// Time at which the next emission of an emitter is due or tried again, s; infinity if there will be none.
double nextEmission(const Emitter& emitter, const EmitterState& state);

}  // namespace engine
