// The forces of obstacles on a particle, as in the paper, and the energy of these forces.
#include "engine/obstacles/obstacles.h"

#include <cmath>
#include <numbers>

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/obstacles/contact.h"

namespace engine {

std::size_t contactGrain(const Obstacles& obstacles) {
    constexpr std::size_t kContactGrain =
        256;  // fewest particles a thread; chosen: the contacts of one take 0.1 to 10 microseconds
    return obstacles.shapes.empty() ? kParticleGrain : kContactGrain;
}

Rebound reboundWith(double restitution) {
    // Bisection of e(zeta) = exp(-pi zeta / sqrt(1 - zeta^2)), which has the same bits on every machine.
    double low = 0.0;
    double high = 1.0;
    constexpr int kHalvings = 60;  // more than a double has bits
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        const double exponent = std::numbers::pi * middle / std::sqrt(1.0 - middle * middle);
        (expNegative(exponent) > restitution ? low : high) = middle;
    }
    return {restitution, restitution > 0.0 ? low : 1.0, false};
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
