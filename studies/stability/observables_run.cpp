// Observables that are computed from the frames of a run, alone or together with the reference run: momentum, energy
// and speeds, and errors of positions, extents and velocities. Also the table of all observables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/run/diagnostics.h"
#include "scenes/text/input_error.h"
#include "studies/common/state_difference.h"
#include "studies/common/timing.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Particles;
using engine::Vec3;

/// Whether an observable is defined for a run without particles at the end.
bool isDefinedWithoutParticles(scenes::Observable observable) {
    return observable == scenes::Observable::pairLaw || observable == scenes::Observable::refusals;
}

/// Kinetic energy of all particles at a speed of a tenth of their radius per second, J. The engine's audit of steps
/// (engine/stepping/step_audit.cpp) makes the same allowance for slow motion.
double slowKinetic(const Particles& particles) {
    double sum = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const double speed = 0.1 * particles.radius[p];
        sum += 0.5 * particles.mass[p] * speed * speed;
    }
    return sum;
}

/// Relative rounding error of sums of potential energies: about 1e-16 for each of a thousand particles, and a margin.
constexpr double kSumRounding = 1e-12;

/// Whether a run has as many frames and as many particles at the end as the reference run.
bool isComparable(const ObservableInput& input) {
    return input.reference != nullptr && input.reference->frames.size() == input.run.frames.size() &&
           input.reference->frames.back().count() == input.run.frames.back().count();
}

/// The largest difference of a quantity (m) between corresponding frames of the run and the reference run, over all
/// frames with particles, in radii of the first particle.
template <class Quantity>
double largestDifference(const ObservableInput& input, const Quantity& quantity) {
    if (!isComparable(input)) return kInfinity;
    double largest = 0.0;
    for (std::size_t k = 0; k < input.run.frames.size(); ++k) {
        const Particles& ours = input.run.frames[k];
        const Particles& reference = input.reference->frames[k];
        if (ours.count() != reference.count()) return kInfinity;
        if (ours.count() > 0) largest = std::max(largest, std::abs(quantity(ours) - quantity(reference)));
    }
    return largest / input.run.frames.back().radius.front();
}

/// Largest vertical velocity of the center of mass over the frames of a run, m/s.
double fastestRise(const Run& run) {
    double fastest = -kInfinity;
    for (const Particles& frame : run.frames) {
        double momentum = 0.0;
        double mass = 0.0;
        for (std::size_t p = 0; p < frame.count(); ++p) {
            momentum += frame.mass[p] * frame.velocity[p].y();
            mass += frame.mass[p];
        }
        fastest = std::max(fastest, momentum / mass);
    }
    return fastest;
}

}  // namespace

double measure(scenes::Observable observable, const ObservableInput& input) {
    if (input.run.frames.back().count() == 0 && !isDefinedWithoutParticles(observable))
        throw scenes::InputError(input.scene.sourceName,
                                 fmt::format("no particle is there at the end of the run, so there is no {}",
                                             scenes::infoOf(observable).name));
    using Function = double (*)(const ObservableInput&);
    // The functions in the order of scenes::Observable.
    static constexpr Function kFunctions[] = {
        pairLaw,         momentumDrift, energyRise,       positionError, heightError, frontError, radiusError,
        statisticsError, reboundError,  restitutionError, largestSpeed,  medianSpeed, fragments,  spacing,
        tunnelingCount,  penetration,   refusals,         stepBound,     order,       cost};
    return kFunctions[static_cast<std::size_t>(observable)](input);
}

/// Observable: the largest |P(t) - P(0)| / sum |p(0)| of the linear or the angular momentum over the frames of a run.
double momentumDrift(const ObservableInput& input) {
    const Particles& first = input.run.frames.front();
    const MomentumScale scale = momentumScale(first);
    const Vec3 linear = engine::linearMomentum(first);
    const Vec3 angular = engine::angularMomentum(first);
    double worst = 0.0;
    for (const Particles& frame : input.run.frames) {
        worst = std::max(worst, (engine::linearMomentum(frame) - linear).norm() / scale.linear);
        worst = std::max(worst, (engine::angularMomentum(frame) - angular).norm() / scale.angular);
    }
    return worst;
}

/// Observable: the largest rise of the total energy from one frame to the next, divided by the number of steps between
/// them and by a kinetic energy: the larger one of the two frames plus slowKinetic(), as in the engine's check
/// (step_audit.h) of steps. The scene must be closed, without births.
double energyRise(const ObservableInput& input) {
    engine::ForceEvaluator evaluator(forceFieldOf(input.scene.setup), input.scene.setup.forces);
    double worst = 0.0;
    engine::Energy earlier = engine::energy(evaluator, input.run.frames.front());
    for (std::size_t k = 1; k < input.run.frames.size(); ++k) {
        const Particles& frame = input.run.frames[k];
        const engine::Energy later = engine::energy(evaluator, frame);
        const double potential = std::abs(later.pairs) + std::abs(later.contacts) + std::abs(later.gravity);
        const double scale = std::max(earlier.kinetic, later.kinetic) + slowKinetic(frame) + kSumRounding * potential;
        const auto steps = static_cast<double>(input.run.stepsUntil[k] - input.run.stepsUntil[k - 1]);
        worst = std::max(worst, (later.total() - earlier.total()) / steps / scale);
        earlier = later;
    }
    return worst;
}

/// Observable: the largest speed of a particle in any frame of a run.
double largestSpeed(const ObservableInput& input) {
    double largest = 0.0;
    for (const Particles& frame : input.run.frames) largest = std::max(largest, engine::largestSpeed(frame));
    return largest;
}

/// Observable: the median speed at the end of a run, near zero for a heap at rest, even if a few particles still fall.
double medianSpeed(const ObservableInput& input) {
    std::vector<double> speeds;
    for (const Vec3& velocity : input.run.frames.back().velocity) speeds.push_back(velocity.norm());
    return median(std::move(speeds));
}

/// Observable: the deepest penetration of a particle into an obstacle at the ends of the frames, in its radii.
double penetration(const ObservableInput& input) {
    return input.run.end.wallDepths.deepest;
}

/// Observable: number of births in a run that were refused because the position was occupied.
double refusals(const ObservableInput& input) {
    return static_cast<double>(engine::refusalCount(input.run.end));
}

/// Observable: root mean square position error of the particles at the end of a run, each in its own radius.
double positionError(const ObservableInput& input) {
    if (!isComparable(input)) return kInfinity;
    const Particles& ours = input.run.frames.back();
    return positionError(ours, input.reference->frames.back(), ours.count()).rms;
}

/// Observable: largest error of the height of the heaviest particle over the frames of a run.
double heightError(const ObservableInput& input) {
    return largestDifference(input, [](const Particles& frame) {
        const auto heaviest = std::ranges::max_element(frame.mass) - frame.mass.begin();
        return frame.position[static_cast<std::size_t>(heaviest)].y();
    });
}

/// Observable: largest error of the front, the largest x of all particles, over the frames of a run.
double frontError(const ObservableInput& input) {
    return largestDifference(input, [](const Particles& frame) {
        double furthest = -kInfinity;
        for (const Vec3& position : frame.position) furthest = std::max(furthest, position.x());
        return furthest;
    });
}

/// Observable: largest error of R90, the radius that holds 90 % of the particles, over the frames of a run.
double radiusError(const ObservableInput& input) {
    return largestDifference(input, [](const Particles& frame) { return bulkStatistics(frame).r90; });
}

/// Observable: largest relative error of the bulk statistics at the end of a run. Errors of center of mass, radius of
/// gyration and R90 are in units of the reference's R90, errors of z90 in units of the reference's z90.
double statisticsError(const ObservableInput& input) {
    if (!isComparable(input)) return kInfinity;
    const BulkStatistics ours = bulkStatistics(input.run.frames.back());
    const BulkStatistics reference = bulkStatistics(input.reference->frames.back());
    return std::max({(ours.center - reference.center).norm() / reference.r90,
                     std::abs(ours.gyration - reference.gyration) / reference.r90,
                     std::abs(ours.r90 - reference.r90) / reference.r90,
                     std::abs(ours.z90 - reference.z90) / std::abs(reference.z90)});
}

/// Observable: relative error of the largest vertical velocity of the center of mass, after a rebound.
double reboundError(const ObservableInput& input) {
    if (!isComparable(input)) return kInfinity;
    return std::abs(fastestRise(input.run) / fastestRise(*input.reference) - 1.0);
}

/// Observable: largest relative error of the speed of a particle at the end of a run.
double restitutionError(const ObservableInput& input) {
    if (!isComparable(input)) return kInfinity;
    double worst = 0.0;
    for (std::size_t p = 0; p < input.run.frames.back().count(); ++p) {
        const double ours = input.run.frames.back().velocity[p].norm();
        const double reference = input.reference->frames.back().velocity[p].norm();
        worst = std::max(worst, std::abs(ours / reference - 1.0));
    }
    return worst;
}

}  // namespace studies
