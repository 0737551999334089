// The state of all particles as a structure of arrays, in order of birth. A particle's index in the arrays equals its
// id until an earlier particle is removed; what identifies a particle throughout a run is its id.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

struct Particles {
    std::vector<Vec3> position;           ///< m
    std::vector<Vec3> velocity;           ///< m/s
    std::vector<double> radius;           ///< m
    std::vector<double> mass;             ///< kg
    std::vector<double> birthTime;        ///< s
    std::vector<std::uint32_t> material;  ///< index of the particle's material in the list of the setup
    std::vector<std::uint32_t> id;        ///< particles are numbered 0, 1, 2, ... in order of birth
    std::vector<double> enthalpy;         ///< J; empty in a run without heat
    std::uint32_t nextId = 0;

    std::size_t count() const { return position.size(); }
};

/// Calls visit(array) for each array of the particles, in the order of their declaration. For const particles, visit
/// gets const arrays. Only the array of enthalpies may be empty.
template <class ParticleArrays, class Visit>
void forEachArray(ParticleArrays& particles, Visit&& visit) {
    visit(particles.position);
    visit(particles.velocity);
    visit(particles.radius);
    visit(particles.mass);
    visit(particles.birthTime);
    visit(particles.material);
    visit(particles.id);
    visit(particles.enthalpy);
}

/// A particle to append. The material is an index into the materials of the setup.
struct NewParticle {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double radius = 0.15;          ///< m
    double mass = 1.0;             ///< kg
    double birthTime = 0.0;        ///< s
    std::uint32_t material = 0;
    double enthalpy = std::numeric_limits<double>::quiet_NaN();  ///< J; NaN in a run without heat
};

/// Appends a particle with the next id.
void append(Particles& particles, const NewParticle& particle);

/// Removes all but the first `count` particles; the next particles get the ids of the removed ones.
void truncate(Particles& particles, std::size_t count);

/// Removes the particles for whose index stays(index) is false; no later particle gets their ids. stays() is called
/// once for each index, in ascending order.
template <class Stays>
void keepWhere(Particles& particles, const Stays& stays) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        if (!stays(p)) continue;
        forEachArray(particles, [&](auto& array) {
            if (!array.empty()) array[kept] = array[p];
        });
        ++kept;
    }
    forEachArray(particles, [&](auto& array) { array.resize(std::min(array.size(), kept)); });
}

}  // namespace engine
