// The forces of obstacles on a particle, as in the paper, and the energy of these forces.
#include "engine/force_law/obstacles.h"

#include "engine/core/parallel.h"
#include "engine/force_law/contact.h"

namespace engine {

std::size_t contactGrain(const Obstacles& obstacles) {
    constexpr std::size_t kContactGrain =
        256;  // fewest particles a thread; chosen: the contacts of one take 0.1 to 10 microseconds
    return obstacles.shapes.empty() ? kParticleGrain : kContactGrain;
}

ContactSums sumContacts(const Obstacles& obstacles, const Probe& probe) {
    ContactSums sums;
    forEachTouched(obstacles, probe.position, probe.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, obstacles, probe);
        addForce(surface, contact, probe, sums.force);
        sums.energy += contactEnergy(contact);
    });
    return sums;
}

}  // namespace engine
