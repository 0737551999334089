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

std::optional<BoundingBox> boundsOf(const Obstacle& obstacle) {
    if (const auto* box = std::get_if<Box>(&obstacle)) return BoundingBox{box->minimum, box->maximum};
    if (const auto* walls = std::get_if<Container>(&obstacle)) return BoundingBox{walls->minimum, walls->maximum};
    if (const auto* sphere = std::get_if<Sphere>(&obstacle)) {
        const Vec3 half = Vec3::Constant(sphere->radius);
        return BoundingBox{sphere->center - half, sphere->center + half};
    }
    return std::nullopt;
}

ObstacleIndex indexOf(const Obstacles& obstacles) {
    // Fewest boxes and spheres for which the tree is used. Measured with `globular simulate` on the scenes fountain and
    // mud, which have five: they take a twentieth less time.
    constexpr std::size_t kFewest = 4;
    if (obstacles.wall == WallLaw::paper) return {};
    const std::vector<Obstacle>& shapes = obstacles.shapes;
    ObstacleIndex index;
    std::vector<BoundingBox> boxes;
    for (std::uint32_t k = 0; k < shapes.size(); ++k) {
        const bool isSolid = std::holds_alternative<Box>(shapes[k]) || std::holds_alternative<Sphere>(shapes[k]);
        (isSolid ? index.obstacleOf : index.unbounded).push_back(k);
        if (isSolid) boxes.push_back(*boundsOf(shapes[k]));
    }
    if (boxes.size() < kFewest) return {};
    index.solids = BoundingBoxTree(boxes);
    return index;
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
