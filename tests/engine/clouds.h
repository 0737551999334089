// Random sets of particles that the tests of the engine share.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstdint>

#include "engine/core/random.h"
#include "engine/forces/forces.h"
#include "engine/state/particles.h"

namespace clouds {

using engine::randomVector;

/// Particles distributed evenly in a cube of the given half edge (m), with random velocities of up to 1 m/s along each
/// axis.
inline engine::Particles strewn(std::size_t count, double halfEdge, std::uint64_t seed = 7) {
    engine::Particles particles;
    for (std::uint64_t p = 0; p < count; ++p) {
        engine::NewParticle particle;
        particle.position = halfEdge * randomVector(seed, p);
        particle.velocity = randomVector(seed + 1, p);
        engine::append(particles, particle);
    }
    return particles;
}

/// strewn() with radii of 0.1 to 0.2 m and masses of 0.1 to 1.9 kg.
inline engine::Particles strewnUnequal(std::size_t count, double halfEdge, std::uint64_t seed = 7) {
    engine::Particles particles = strewn(count, halfEdge, seed);
    for (std::size_t p = 0; p < count; ++p) {
        const engine::Vec3 random = randomVector(seed + 2, p);
        particles.radius[p] = 0.15 + 0.05 * random.x();
        particles.mass[p] = 1.0 + 0.9 * random.y();
    }
    return particles;
}

/// Runs work() on a number of threads, even where the machine has fewer cores.
template <class Work>
void onThreads(std::size_t threads, const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute(work);
}

inline engine::ForceField forceFieldOf(const engine::Material& material) {
    engine::ForceField field;
    field.materials = {material};
    return field;
}

inline engine::ForceField forceFieldOf(const char* preset) {
    return forceFieldOf(*engine::materialPreset(preset));
}

}  // namespace clouds
