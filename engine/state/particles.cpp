// Adding and removing particles, with arrays of equal length and ids in order of birth.
#include "engine/state/particles.h"

#include <algorithm>
#include <cmath>

namespace engine {

void append(Particles& particles, const NewParticle& particle) {
    particles.position.push_back(particle.position);
    particles.velocity.push_back(particle.velocity);
    particles.radius.push_back(particle.radius);
    particles.mass.push_back(particle.mass);
    particles.birthTime.push_back(particle.birthTime);
    particles.material.push_back(particle.material);
    particles.id.push_back(particles.nextId++);
    if (!std::isnan(particle.enthalpy)) particles.enthalpy.push_back(particle.enthalpy);
}

void truncate(Particles& particles, std::size_t count) {
    if (count < particles.count()) particles.nextId = particles.id[count];
    forEachArray(particles, [&](auto& array) { array.resize(std::min(array.size(), count)); });
}

}  // namespace engine
