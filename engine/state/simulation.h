// The state of a run as plain data: the setup, the particles, and statistics of the steps so far. run/advance.h starts
// and advances a run; data that one step leaves for the next are in stepping/step_cache.h.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "engine/ranks/ranks.h"
#include "engine/state/setup.h"

namespace engine {

/// The reason why a time step was not longer.
enum class StepLimit {
    fixed,         ///< the fixed step that the scene asks for
    error,         ///< the wanted error
    displacement,  ///< a longer step moved a particle further than its radius
    audit,         ///< a longer step gained energy and was rejected
    frame          ///< the end of the requested interval, e.g. a frame
};
inline constexpr std::size_t kStepLimits = 5;

/// Whether a value that was read from a file is one of the enumerators of StepLimit.
constexpr bool isLimit(StepLimit limit) {
    return static_cast<std::size_t>(limit) < kStepLimits;
}

/// Statistics of the time steps of a run.
struct StepStatistics {
    std::uint64_t count = 0;
    double shortest = 0.0;               ///< s
    double longest = 0.0;                ///< s
    std::uint64_t forceEvaluations = 0;  ///< number of passes over all pairs of particles
    std::uint64_t matrices = 0;          ///< number of matrices of the implicit steppers
    std::uint64_t products = 0;          ///< number of products of vectors with these matrices
    std::uint64_t rejected = 0;          ///< number of steps taken back and retried at half the length
    std::uint64_t held = 0;              ///< how often a surface of an obstacle held a particle's center
    std::array<std::uint64_t, kStepLimits> limitedBy{};  ///< number of steps that each StepLimit has limited
    std::array<std::uint64_t, kStepperKinds> takenBy{};  ///< number of steps that each StepperKind has taken

    StepStatistics& operator+=(const StepStatistics& other);
};

/// Adds one step of h seconds to the statistics.
void record(StepStatistics& steps, double h, StepLimit limit, StepperKind stepper);

/// Upper bound on the steps that follow a rejected step. Accepted steps raise it again.
struct StepRestriction {
    double seconds = std::numeric_limits<double>::infinity();
    StepLimit reason = StepLimit::audit;
    std::uint32_t passed = 0;  ///< number of accepted steps since the restriction was set
};

/// How the automatic stepper controls the steps of one stepper; see error_control/step_control.h.
struct StepControl {
    double step = 0.0;         ///< step that is wanted, s; 0 before the stepper is first used
    double stepBefore = 0.0;   ///< step before the last change, s; 0 if there was none
    double ratioBefore = 1.0;  ///< wanted over estimated error of the last step
    double calibration = 1.0;  ///< measured error over the estimate that single steps give
    bool isCalibrated = false;
};

/// A trial run that has gone ahead of the run, and with which the run is compared when it gets as far.
struct TwinRun {
    bool exists = false;
    StepperKind stepper = StepperKind::velocityVerlet;
    double start = 0.0;             ///< s
    double end = 0.0;               ///< s
    double step = 0.0;              ///< mean step, s
    double estimate = 0.0;          ///< mean of the estimates of its steps, without calibration, radii per second
    double cost = 0.0;              ///< force evaluations per second of motion
    std::vector<Vec3> position;     ///< at the end, m
    std::vector<std::uint32_t> id;  ///< of the particles at the end, ascending
    double runCost = 0.0;           ///< what the run had cost at the start, force evaluations
    double runEstimate = 0.0;       ///< integral of the estimates of the run's steps since the start, radii
};

/// What the automatic stepper remembers from one interval to the next; see error_control/auto_stepper.h.
struct AutoState {
    std::array<StepControl, kStepperKinds> controls;  ///< by StepperKind
    TwinRun twin;
    std::uint64_t intervalCount = 0;  ///< number of intervals run so far, each with an error estimate
    std::uint64_t twinCount = 0;      ///< number of twins so far
    std::uint64_t lastTwin = 0;       ///< index of the interval in which the last twin started
    std::uint64_t nextTwin = 0;       ///< index of the interval in which the next twin starts
    std::uint64_t nextCandidate = 0;  ///< index of the interval from which the next twin may be of another stepper
    double runCostPerSecond = 0.0;    ///< cost of the last interval, force evaluations per second of motion
    double costAtTwin = 0.0;          ///< runCostPerSecond when the last twin started
    bool isLimited = false;           ///< whether something else than the error limits the steps, as far as is known
    bool isSecond = false;            ///< whether the next candidate follows the last one without a pause
    StepperKind lastCandidate = StepperKind::velocityVerlet;  ///< the stepper that was tried last
    double errorSum = 0.0;      ///< sum of the error estimates of intervals, radii per second
    double largestError = 0.0;  ///< largest error estimate of an interval, radii per second
    double estimateCost = 0.0;  ///< force evaluations spent on twins
};

/// How far scaled walls let particles in, measured at the ends of frames.
struct WallDepths {
    double deepest = 0.0;              ///< deepest penetration of a particle so far, in its radii: 1 at the center
    std::uint64_t centersOutside = 0;  ///< most centers that lay beyond a surface at once
};

/// What an obstacle has given to the particles since the start of a run. The load on the obstacle itself is the
/// opposite.
struct ObstacleLoad {
    Vec3 impulse = Vec3::Zero();         ///< N s
    Vec3 angularImpulse = Vec3::Zero();  ///< about the obstacle's pivot, N m s
    double work = 0.0;                   ///< J
};

/// What a run has booked of heat. Nothing in a run without heat.
struct HeatState {
    std::uint64_t exchangeCount = 0;  ///< number of exchanges so far
    /// Energy of motion that has become heat but is not given to the particles yet, J; below zero where steps have
    /// gained energy.
    double pending = 0.0;
    double received = 0.0;   ///< from obstacles and air since the start, J
    double damped = 0.0;     ///< kinetic and potential energy that became heat, J
    double ofMelting = 0.0;  ///< kinetic and potential energy that changing constants took from heat, J
};

/// What a run has booked of the random motion of its particles. Nothing in a run without agitation.
struct AgitationState {
    std::uint64_t count = 0;  ///< how often random impulses were given so far
    double work = 0.0;        ///< kinetic energy that they gave, J
};

struct StepCache;

/// Owns the step cache of a simulation and copies it with the simulation. The type of the cache is incomplete here, so
/// that code that reads the state does not depend on neighbor lists.
class StepCachePointer {
 public:
    StepCachePointer();  ///< makes an empty step cache
    StepCachePointer(const StepCachePointer& other);
    StepCachePointer(StepCachePointer&& other) noexcept;
    StepCachePointer& operator=(const StepCachePointer& other);
    StepCachePointer& operator=(StepCachePointer&& other) noexcept;
    ~StepCachePointer();

    StepCache* operator->() { return cache_.get(); }
    const StepCache* operator->() const { return cache_.get(); }
    StepCache& operator*() { return *cache_; }
    const StepCache& operator*() const { return *cache_; }

 private:
    std::unique_ptr<StepCache> cache_;
};

struct Simulation {
    Setup setup;
    const Ranks* ranks = &Ranks::alone();  ///< the processes that share the particles
    Particles particles;                   ///< those of this process, in order of id
    std::vector<EmitterState> emitters;
    std::uint64_t removedCount = 0;                     ///< particles removed outside a bounded world
    std::uint64_t largestCountBeforeRemoval = 0;        ///< largest particle count when particles were removed
    double time = 0.0;                                  ///< s
    StepperKind stepper = StepperKind::velocityVerlet;  ///< stepper in use; never automatic
    StepRestriction restriction;
    AutoState automatic;
    StepStatistics steps;
    WallDepths wallDepths;
    HeatState heat;
    AgitationState agitation;
    std::vector<ObstacleLoad> loads;  ///< of the obstacles, in their order; empty where none are recorded
    StepCachePointer cache;
    /// Called before every step with the simulation that takes it, which is a copy in the trial runs of error
    /// estimates; may be empty. To end advance() inside an interval, it throws Stopped. The simulation is then
    /// somewhere between two points in time that a run reaches, so that nothing can be continued from it.
    std::function<void(const Simulation&)> beforeStep;
};

/// Thrown by Simulation::beforeStep, and therefore by advance(), where a run is to end before the requested time.
class Stopped : public std::exception {};

/// Thrown when a run has become unstable. what() names time, step, particle, position, speed, step size and what to
/// change.
class InstabilityError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The number of particles on all ranks.
std::uint64_t countOfAll(const Simulation& simulation);

/// The largest number of particles that the run has had so far.
std::uint64_t largestCount(const Simulation& simulation);

/// Number of particles that all emitters together have emitted.
std::uint64_t birthCount(const Simulation& simulation);

/// Number of particles that all emitters together were to emit until now, but have not emitted for want of room.
std::uint64_t refusalCount(const Simulation& simulation);

}  // namespace engine
