// The state of all particles as a structure of arrays, in order of birth. Index and id agree until a particle has left;
// code that needs identity uses the id.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

struct Particles {
    std::vector<Vec3> position;           ///< m
    std::vector<Vec3> velocity;           ///< m/s
    std::vector<double> radius;           ///< m
    std::vector<double> mass;             ///< kg
    std::vector<double> birthTime;        ///< s
    std::vector<std::uint32_t> material;  ///< index into the materials of the set-up
    std::vector<std::uint32_t> id;        ///< ascending: 0, 1, 2, ... in order of birth
    std::uint32_t nextId = 0;

    std::size_t count() const { return position.size(); }
};

/// One particle on its way into Particles.
struct NewParticle {
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    double radius = 0.15;
    double mass = 1.0;
    double birthTime = 0.0;
    std::uint32_t material = 0;
};

/// Appends a particle with the next id.
void append(Particles& particles, const NewParticle& particle);

/// Keeps the first `count` particles; the ids of the others may be given again.
void truncate(Particles& particles, std::size_t count);

/// Keeps the particles for whose index stays(index) is true; it is called once for each index in ascending order.
template <class Stays>
void keepWhere(Particles& particles, const Stays& stays) {
    std::size_t saved = 0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        if (!stays(p)) continue;
        particles.position[saved] = particles.position[p];
        particles.velocity[saved] = particles.velocity[p];
        particles.radius[saved] = particles.radius[p];
        particles.mass[saved] = particles.mass[p];
        particles.birthTime[saved] = particles.birthTime[p];
        particles.material[saved] = particles.material[p];
        particles.id[saved] = particles.id[p];
        ++saved;
    }
    const std::uint32_t nextId = particles.nextId;
    truncate(particles, saved);
    particles.nextId = nextId;  // ids are not used again
}

}  // namespace engine
