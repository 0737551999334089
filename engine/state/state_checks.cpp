// Vectorized checks of positions and velocities, and the error message that names an invalid particle.
#include "engine/state/state_checks.h"

#include <cmath>
#include <cstdint>
#include <sstream>

#include "engine/core/parallel.h"

namespace engine {
namespace {

/// Whether every component of the vectors begin to end - 1 is below a limit in magnitude. Written without a branch, so
/// that the compiler vectorizes the loop.
bool areBelow(const std::vector<Vec3>& vectors, std::size_t begin, std::size_t end, double limit) {
    if (begin == end) return true;
    const double* const numbers = vectors.front().data();
    std::uint64_t others = 0;
    for (std::size_t k = 3 * begin; k < 3 * end; ++k)
        others |= std::abs(numbers[k]) < limit ? 0U : 1U;  // a NaN counts as too large
    return others == 0;
}

/// Throws an InstabilityError that names a particle and the settings to change. The automatic stepper ignores
/// physics.step, so physics.error is named for it.
[[noreturn]] void report(const Simulation& simulation, std::size_t p, double h) {
    const Vec3& x = simulation.particles.position[p];
    std::ostringstream text;
    text << "the simulation became unstable: particle " << simulation.particles.id[p] << " is at (" << x.x() << ", "
         << x.y() << ", " << x.z() << ") m with speed " << simulation.particles.velocity[p].stableNorm()
         << " m/s at time " << simulation.time << " s, ";
    if (h > 0.0)
        text << "after " << simulation.steps.count << (simulation.steps.count == 1 ? " step" : " steps")
             << ", in a step of " << h << " s; lower "
             << (simulation.setup.stepper == StepperKind::automatic ? "physics.error" : "physics.step")
             << ", or raise material.mass";
    else
        text << "before its first step; positions must be within " << kWorldLimit << " m and speeds below " << kFastest
             << " m/s: change the body or the emitter that it comes from";
    throw InstabilityError(text.str());
}

}  // namespace

bool isValid(const Particles& particles) {
    return holdsInRanges(particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        return areBelow(particles.position, begin, end, kWorldLimit) &&
               areBelow(particles.velocity, begin, end, kFastest);
    });
}

void reportInstability(const Simulation& simulation, double h) {
    requireValid(simulation, h);
    std::size_t fastest = 0;
    const Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (squaredLength(particles.velocity[p]) > squaredLength(particles.velocity[fastest])) fastest = p;
    report(simulation, fastest, h);
}

void requireValid(const Simulation& simulation, double h) {
    const Particles& particles = simulation.particles;
    if (isValid(particles)) return;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (!isValid(particles.position[p], particles.velocity[p])) report(simulation, p, h);
}

}  // namespace engine
