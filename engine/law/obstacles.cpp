// Obstacles as forces, the paper's way, and the energy that goes with them.
#include "engine/law/obstacles.h"

#include "engine/core/parallel.h"
#include "engine/law/obstacle_surfaces.h"

namespace engine {

std::size_t grainAmong(const Scenery& scenery) {
    constexpr std::size_t kContactGrain = 256;  // chosen: most contacts take a tenth of a microsecond, some a hundred
    return scenery.colliders.empty() ? kParticleGrain : kContactGrain;
}

Vec3 contactForce(const Scenery& scenery, const Probe& probe) {
    Vec3 force = Vec3::Zero();
    forEachTouched(scenery, probe.position, probe.radius, [&](const Surface& surface) {
        addForce(surface, contactWith(surface, scenery.law, probe), probe, force);
    });
    return force;
}

double contactEnergy(const Scenery& scenery, const Probe& probe) {
    double energy = 0.0;
    forEachTouched(scenery, probe.position, probe.radius,
                   [&](const Surface& surface) { energy += surfaceEnergy(surface, scenery.law, probe); });
    return energy;
}

ContactAnswer contactForceAndEnergy(const Scenery& scenery, const Probe& probe) {
    ContactAnswer answer;
    forEachTouched(scenery, probe.position, probe.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, scenery.law, probe);
        addForce(surface, contact, probe, answer.force);
        answer.energy += contactEnergy(contact);
    });
    return answer;
}

}  // namespace engine
