// Emitters: nozzles that add particles on a schedule. An emission that would overlap a particle waits a quarter of an
// interval, and again until its place is clear, and is counted as refused. The times of emission do not depend on the
// steps. The whole state of an emitter is a few counters; stepping/population.h emits.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Due times are sums of many intervals, so times that differ by less than this are meant to be the same moment, s.
inline constexpr double kSameMoment = 1e-9;

/// Which sites emit when a particle is due.
enum class Pick {
    all,    ///< every site, each on its own schedule
    random  ///< one site, drawn at random from the seed
};

struct Emitter {
    std::vector<Vec3> sites;                                          ///< where particles are emitted, m
    Vec3 velocity = Vec3::Zero();                                     ///< of an emitted particle, m/s
    double interval = 0.1;                                            ///< between emissions of a schedule, s
    double start = 0.0;                                               ///< first emission, s
    double until = std::numeric_limits<double>::infinity();           ///< no emission is due at or after this time, s
    std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();  ///< most particles emitted in all
    Pick pick = Pick::all;
    double clearance = 1.0;  ///< least distance to any particle, in sums of radii; 0 allows overlaps
    double jitter = 0.0;     ///< random displacement across the velocity, up to this many radii
    std::uint32_t material = 0;
};

/// When the next particle of one schedule is due. An emitter has a schedule per site, or a single one if it picks at
/// random.
struct Schedule {
    double origin = 0.0;  ///< emission number k is due at origin + k intervals, s; a delay moves the origin
    double due = 0.0;     ///< s
    std::uint64_t births = 0;
    bool delayed = false;  ///< whether the emission that is due has found its place taken before
};

struct EmitterState {
    std::vector<Schedule> schedules;
    std::uint64_t births = 0;
    std::uint64_t refusals = 0;  ///< emissions that found their place taken when they were due; each counts once
};

/// Two unit vectors that span a plane.
struct PlaneAxes {
    Vec3 first = Vec3::UnitX();
    Vec3 second = Vec3::UnitZ();
};

/// Axes of the plane across a direction of any length; the x and z axes where the direction is zero.
PlaneAxes axesAcross(const Vec3& direction);

/// Hexagonally packed sites of a disc-shaped nozzle: a center with whole rings around it, in the plane across the
/// direction.
/// @param radius   largest distance from the center, m
/// @param spacing  distance between neighboring sites, m
std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// The state before the first emission.
EmitterState initialState(const Emitter& emitter);

/// Whether emissions can have led to a state: its times are finite and on or behind schedule, and its counts agree.
bool isReachable(const Emitter& emitter, const EmitterState& state);

/// When the schedule's next emission is due if nothing delays it, s. Counting from the start keeps the due times of an
/// undisturbed schedule free of accumulated rounding.
double dueTime(const Emitter& emitter, const Schedule& schedule);

/// When the next emission is due or tried again, s; infinity if there will be none.
double nextEmission(const Emitter& emitter, const EmitterState& state);

}  // namespace engine
