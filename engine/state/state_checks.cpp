// Vectorized checks of positions and velocities, and the error message that names an invalid particle.
#include "engine/state/state_checks.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

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

/// The text of an InstabilityError that names a particle and the settings to change. The automatic stepper ignores
/// physics.step, so physics.error is named for it.
std::string describe(const Simulation& simulation, std::size_t p, double h) {
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
    return text.str();
}

/// Throws, on all ranks, an InstabilityError that names a particle: of the ranks' candidates the one with the largest
/// value and, of equal ones, the lowest id.
/// @param p      index of the rank's candidate; the number of particles if it has none
/// @param value  not NaN
[[noreturn]] void report(const Simulation& simulation, std::size_t p, double value, double h) {
    const Particles& particles = simulation.particles;
    const bool exists = p < particles.count();
    constexpr double kNone = -std::numeric_limits<double>::infinity();
    const double largest = largestOfAll(*simulation.ranks, exists ? value : kNone);
    const double id = exists && value == largest ? -static_cast<double>(particles.id[p]) : kNone;
    std::string text;
    if (largestOfAll(*simulation.ranks, id) == id && id != kNone) text = describe(simulation, p, h);
    const std::vector<double> ofAll = simulation.ranks->gatherAll(std::vector<double>(text.begin(), text.end()));
    throw InstabilityError(std::string(ofAll.begin(), ofAll.end()));
}

}  // namespace

bool isValid(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const bool isOwnValid = holdsInRanges(particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        return areBelow(particles.position, begin, end, kWorldLimit) &&
               areBelow(particles.velocity, begin, end, kFastest);
    });
    return holdsOnAll(*simulation.ranks, isOwnValid);
}

void reportInstability(const Simulation& simulation, double h) {
    requireValid(simulation, h);
    const Particles& particles = simulation.particles;
    std::size_t fastest = 0;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (squaredLength(particles.velocity[p]) > squaredLength(particles.velocity[fastest])) fastest = p;
    report(simulation, fastest, particles.count() == 0 ? 0.0 : squaredLength(particles.velocity[fastest]), h);
}

void requireValid(const Simulation& simulation, double h) {
    if (isValid(simulation)) return;
    const Particles& particles = simulation.particles;
    std::size_t p = 0;
    while (p < particles.count() && isValid(particles.position[p], particles.velocity[p])) ++p;
    report(simulation, p, 0.0, h);
}

}  // namespace engine
