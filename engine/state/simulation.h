// The state of a run: what the scene set up, where the particles are now, and what the steps so far were like. Plain
// data: run/advance.h starts a run and moves it on; what steps keep for each other is in stepping/step_cache.h.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "engine/state/setup.h"

namespace engine {

/// What kept a step from being longer.
enum class StepLimit {
    fixed,         ///< the scene's fixed step
    error,         ///< the wanted error
    displacement,  ///< a particle may not move further than its radius in one step
    audit,         ///< a longer step gained energy
    frame          ///< the interval that was asked for, e.g. one frame
};
inline constexpr std::size_t kStepLimits = 5;

/// Whether a value read from outside is one of the limits.
constexpr bool isLimit(StepLimit limit) {
    return static_cast<std::size_t>(limit) < kStepLimits;
}

/// Counts and lengths of the steps of a run.
struct StepStatistics {
    std::uint64_t count = 0;
    double shortest = 0.0;                               ///< s
    double longest = 0.0;                                ///< s
    std::uint64_t forceEvaluations = 0;                  ///< passes over all pairs
    std::uint64_t products = 0;                          ///< products of the implicit steppers' matrix with a vector
    std::uint64_t rejected = 0;                          ///< steps taken back and retried at half the length
    std::array<std::uint64_t, kStepLimits> limitedBy{};  ///< number of steps, by StepLimit
    std::array<std::uint64_t, kStepperKinds> takenBy{};  ///< number of steps, by StepperKind

    StepStatistics& operator+=(const StepStatistics& other);
};

/// Counts one step of h seconds.
void record(StepStatistics& steps, double h, StepLimit limit, StepperKind stepper);

/// The longest step that the audit allows for a while, after it has rejected a longer one.
struct StepRestriction {
    double seconds = std::numeric_limits<double>::infinity();
    StepLimit reason = StepLimit::audit;
    std::uint32_t passed = 0;  ///< accepted steps since the restriction was set
};

/// What the automatic stepper knows of one candidate.
struct AutoChoice {
    double step = 0.0;  ///< the step that just meets the wanted error, s; 0 before the first estimate
    double cost = std::numeric_limits<double>::infinity();  ///< at that step, force evaluations per second of motion
    StepLimit reason = StepLimit::error;                    ///< what keeps the step from being longer
    double growth = 1.0;    ///< factor by which errors grow beyond one interval; the measured rate is multiplied by it
    bool followed = false;  ///< whether the growth was measured on this candidate, not taken over from another
};

struct AutoState {
    std::array<AutoChoice, kStepperKinds> choices;  ///< by StepperKind
    std::uint64_t intervalCount = 0;                ///< intervals run so far
    std::uint64_t nextEstimate = 0;                 ///< index of the interval in which the error is estimated next
    std::uint64_t estimateCount = 0;                ///< number of error estimates so far
    double errorSum = 0.0;                          ///< sum of the estimates, radii per second
    double largestError = 0.0;                      ///< largest estimate, radii per second
    double rmsAcceleration = 0.0;  ///< RMS of the acceleration other than gravity at the last estimate, m/s^2
    double estimateCost = 0.0;     ///< force evaluations that estimates have cost and the run did not go on with
};

struct StepCache;

/// Owns a step cache. Its type is known to stepping/ alone, so that a reader of the state need not know the neighbor
/// list; copying a simulation copies the cache with it.
class StepCachePointer {
 public:
    StepCachePointer();  ///< an empty cache
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
    Particles particles;
    std::vector<EmitterState> emitters;
    std::uint64_t removedCount = 0;                     ///< particles that have left a bounded world
    std::uint64_t largestCountBeforeRemoval = 0;        ///< most particles there were when some were removed
    double time = 0.0;                                  ///< s
    StepperKind stepper = StepperKind::velocityVerlet;  ///< in use; never the automatic one
    StepRestriction restriction;
    AutoState automatic;
    StepStatistics steps;
    StepCachePointer cache;
};

/// The run left the finite numbers. what() names time, step, particle, position, speed, step size and what to change.
class InstabilityError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The largest number of particles that the run has had so far, now or when some were removed.
std::uint64_t largestCount(const Simulation& simulation);

/// Particles that all emitters have emitted.
std::uint64_t birthCount(const Simulation& simulation);

/// Emissions that found their place taken when they were due, over all emitters; each counts once.
std::uint64_t refusalCount(const Simulation& simulation);

}  // namespace engine
