// Observables of what a run has to keep: momentum, energy, a bounded speed, the count of refused births.
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/run/diagnostics.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Particles;
using engine::Vec3;

/// Sum of |p| and of |x x p| over the particles.
struct MomentumScale {
    double linear = 0.0;
    double angular = 0.0;
};

MomentumScale scaleOf(const Particles& particles) {
    MomentumScale scale;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const Vec3 momentum = particles.mass[p] * particles.velocity[p];
        scale.linear += momentum.norm();
        scale.angular += particles.position[p].cross(momentum).norm();
    }
    return scale;
}

/// Kinetic energy of all particles at a tenth of a radius per second, as in engine/stepping/step_audit.h, J.
double slowKinetic(const Particles& particles) {
    double sum = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const double speed = 0.1 * particles.radius[p];
        sum += 0.5 * particles.mass[p] * speed * speed;
    }
    return sum;
}

/// Shares of the potential energies that sums over a state round away, a thousand particles at 1e-16 each and some.
constexpr double kRoundedAway = 1e-12;

}  // namespace

/// The largest |P(t) - P(0)| / sum |p(0)| over the frames, or that of the angular momentum if it is larger.
double momentumDrift(const ObservableInput& trial) {
    const Particles& first = trial.run.frames.front();
    const MomentumScale scale = scaleOf(first);
    const Vec3 linear = engine::linearMomentum(first);
    const Vec3 angular = engine::angularMomentum(first);
    double worst = 0.0;
    for (const Particles& frame : trial.run.frames) {
        worst = std::max(worst, (engine::linearMomentum(frame) - linear).norm() / scale.linear);
        worst = std::max(worst, (engine::angularMomentum(frame) - angular).norm() / scale.angular);
    }
    return worst;
}

/// The largest rise of the total energy from a frame to the next, for each step between them, over the kinetic energy:
/// the larger of the two, and that of a slow motion, as the audit of the steps counts it. The scene must be closed: no
/// births.
double energyRise(const ObservableInput& trial) {
    const engine::Setup& setup = trial.scene.setup;
    engine::ForceEvaluator evaluator({setup.materials, setup.gravity, setup.obstacles}, setup.forces);
    double worst = 0.0;
    engine::Energy earlier = engine::energy(evaluator, trial.run.frames.front());
    for (std::size_t k = 1; k < trial.run.frames.size(); ++k) {
        const Particles& frame = trial.run.frames[k];
        const engine::Energy later = engine::energy(evaluator, frame);
        const double potential = std::abs(later.pairs) + std::abs(later.contacts) + std::abs(later.gravity);
        const double scale = std::max(earlier.kinetic, later.kinetic) + slowKinetic(frame) + kRoundedAway * potential;
        const auto steps = static_cast<double>(trial.run.stepsUntil[k] - trial.run.stepsUntil[k - 1]);
        worst = std::max(worst, (later.total() - earlier.total()) / steps / scale);
        earlier = later;
    }
    return worst;
}

/// Over all frames.
double largestSpeed(const ObservableInput& trial) {
    double largest = 0.0;
    for (const Particles& frame : trial.run.frames) largest = std::max(largest, engine::largestSpeed(frame));
    return largest;
}

/// At the end. A heap that has come to rest has next to none, however fast a few still fall onto it.
double medianSpeed(const ObservableInput& trial) {
    std::vector<double> speeds;
    for (const Vec3& velocity : trial.run.frames.back().velocity) speeds.push_back(velocity.norm());
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    std::nth_element(speeds.begin(), middle, speeds.end());
    return *middle;
}

double refusals(const ObservableInput& trial) {
    return static_cast<double>(engine::refusalCount(trial.run.end));
}

}  // namespace studies
