// Obstacles as forces, as the paper has them, and the energy that goes with these forces.
#include "engine/law/obstacles.h"

#include "engine/core/parallel.h"
#include "engine/law/obstacle_surfaces.h"

namespace engine {

std::size_t contactGrain(const Obstacles& obstacles) {
    constexpr std::size_t kContactGrain =
        256;  // chosen: most contacts take a tenth of a microsecond, some a hundred times that
    return obstacles.shapes.empty() ? kParticleGrain : kContactGrain;
}

Vec3 contactForce(const Obstacles& obstacles, const Probe& probe) {
    Vec3 force = Vec3::Zero();
    forEachTouched(obstacles, probe.position, probe.radius, [&](const Surface& surface) {
        addForce(surface, contactWith(surface, obstacles.law, probe), probe, force);
    });
    return force;
}

double contactEnergy(const Obstacles& obstacles, const Probe& probe) {
    double energy = 0.0;
    forEachTouched(obstacles, probe.position, probe.radius,
                   [&](const Surface& surface) { energy += surfaceEnergy(surface, obstacles.law, probe); });
    return energy;
}

ContactAnswer contactForceAndEnergy(const Obstacles& obstacles, const Probe& probe) {
    ContactAnswer answer;
    forEachTouched(obstacles, probe.position, probe.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, obstacles.law, probe);
        addForce(surface, contact, probe, answer.force);
        answer.energy += contactEnergy(contact);
    });
    return answer;
}

}  // namespace engine
