// Obstacles as forces, the paper's way, and the energy that goes with them.
#include "engine/colliders.h"

#include "engine/surfaces.h"

namespace engine {
namespace {

template <class Visit>
void forEachTouched(const Scenery& scenery, const Probe& probe, const Visit& visit) {
    forEachSurface(scenery, probe.position, [&](const Surface& surface) {
        if (surface.height < probe.radius) visit(surface);
    });
}

}  // namespace

Vec3 contactForce(const Scenery& scenery, const Probe& probe) {
    Vec3 force = Vec3::Zero();
    forEachTouched(scenery, probe, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, scenery.law, probe);
        const double normalSpeed = dot(probe.velocity, surface.normal);
        force += normalForce(contact, normalSpeed) * surface.normal;
        if (probe.friction == 0.0) return;
        const Vec3 slip = probe.velocity - normalSpeed * surface.normal;
        force -= slipDamping(probe.friction, normalForce(contact, 0.0), squaredLength(slip)) * slip;
    });
    return force;
}

double contactEnergy(const Scenery& scenery, const Probe& probe) {
    double energy = 0.0;
    forEachTouched(scenery, probe,
                   [&](const Surface& surface) { energy += surfaceEnergy(surface, scenery.law, probe); });
    return energy;
}

}  // namespace engine
