// Emitters: nozzles that give birth to particles on a schedule. A birth that would overlap a particle waits a quarter
// of an interval, and again until its place is clear, and is counted. When it happens does not depend on the steps.
// Called once a step by the simulation; the whole state is a few counters.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/law/material.h"
#include "engine/neighbors/linked_cells.h"
#include "engine/state/particles.h"

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

/// Hexagonally packed sites of a disc nozzle, a center with whole rings around it.
/// Shape: at most radius from the center, neighbors spacing apart, in the plane across the direction.
std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// Schedules at their first birth.
EmitterState initialState(const Emitter& emitter);

/// Whether births can have led to a state: it is a finite one, on or behind schedule, and its counts agree.
bool isReachable(const Emitter& emitter, const EmitterState& state);

/// When the next birth is due or tried again, s; infinity when there will be none.
double nextBirth(const Emitter& emitter, const EmitterState& state);

/// What births need to know of the rest of the simulation.
struct BirthContext {
    double time = 0.0;            ///< now, s
    Vec3 gravity = Vec3::Zero();  ///< m/s^2, moves a newborn from its due time to now
    std::uint64_t seed = 1;
    std::uint64_t emitterIndex = 0;  ///< keys the random numbers
};

/// How far from its own place a birth looks for others, m. Shape: the largest radius that anybody has, m.
double birthReach(const Emitter& emitter, double largestRadius);

/// Appends the particles that are due at or before the context's time and have room, and adds them to the cells, which
/// hold all others and are as wide as the birth's reach; returns how many. A birth that was due earlier starts where
/// its flight would have taken it by now.
std::size_t emit(const Emitter& emitter, EmitterState& state, const BirthContext& context, const Material& material,
                 Particles& particles, LinkedCells& cells);

}  // namespace engine
