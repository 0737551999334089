// Positions within the world, speeds that are numbers.
#include "engine/soundness.h"

#include <cmath>
#include <sstream>

#include "engine/parallel.h"

namespace engine {
namespace {

bool isSoundAt(const Vec3& position, const Vec3& velocity) {
    // Written so that a NaN fails.
    return std::abs(position.x()) < kWorldLimit && std::abs(position.y()) < kWorldLimit &&
           std::abs(position.z()) < kWorldLimit && std::isfinite(squaredLength(velocity));
}

[[noreturn]] void report(const Simulation& simulation, std::size_t p, double h) {
    const Vec3& x = simulation.particles.position[p];
    std::ostringstream text;
    text << "the simulation became unstable: particle " << simulation.particles.id[p] << " is at (" << x.x() << ", "
         << x.y() << ", " << x.z() << ") m with speed " << simulation.particles.velocity[p].stableNorm()
         << " m/s at time " << simulation.time << " s, step " << simulation.steps.count << " of " << h
         << " s; lower physics.step, or raise material.mass";
    throw InstabilityError(text.str());
}

}  // namespace

bool isSound(const Particles& particles) {
    return largestOver(particles.count(), [&](std::size_t p) {
               return isSoundAt(particles.position[p], particles.velocity[p]) ? 0.0 : 1.0;
           }) == 0.0;
}

void reportInstability(const Simulation& simulation, double h) {
    requireSound(simulation, h);
    std::size_t fastest = 0;
    const Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (squaredLength(particles.velocity[p]) > squaredLength(particles.velocity[fastest])) fastest = p;
    report(simulation, fastest, h);
}

void requireSound(const Simulation& simulation, double h) {
    const Particles& particles = simulation.particles;
    if (isSound(particles)) return;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (!isSoundAt(particles.position[p], particles.velocity[p])) report(simulation, p, h);
}

}  // namespace engine
