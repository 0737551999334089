// Obstacles as repulsors behind their surface. Every shape is reduced to surfaces (signed distance, normal, repulsor
// radius); one contact law then serves them all.
#include "engine/colliders.h"

#include <cmath>
#include <limits>

#include "engine/pair_law.h"

namespace engine {
namespace {

/// One face as a particle sees it.
struct Surface {
    double height = 0.0;          ///< signed distance of the particle's centre, m
    Vec3 normal = Vec3::UnitY();  ///< away from the solid
    double repulsorRadius = 0.5;  ///< m
};

template <class Visit>
void forEachSurface(const Plane& plane, const Vec3& point, double repulsorRadius, const Visit& visit) {
    visit(Surface{dot(point - plane.point, plane.normal), plane.normal, repulsorRadius});
}

template <class Visit>
void forEachSurface(const Container& box, const Vec3& point, double repulsorRadius, const Visit& visit) {
    for (int axis = 0; axis < 3; ++axis) {
        visit(Surface{point[axis] - box.minimum[axis], Vec3::Unit(axis), repulsorRadius});
        visit(Surface{box.maximum[axis] - point[axis], -Vec3::Unit(axis), repulsorRadius});
    }
}

/// Outside the box the normal points from the closest point; inside, out of the nearest face.
template <class Visit>
void forEachSurface(const Box& box, const Vec3& point, double repulsorRadius, const Visit& visit) {
    const Vec3 closest = point.cwiseMax(box.minimum).cwiseMin(box.maximum);
    const Vec3 away = point - closest;
    const double distance = std::sqrt(squaredLength(away));
    if (distance > 0.0) {
        visit(Surface{distance, away / distance, repulsorRadius});
        return;
    }
    Surface nearest{-std::numeric_limits<double>::infinity(), Vec3::UnitY(), repulsorRadius};
    for (int axis = 0; axis < 3; ++axis) {
        const double below = box.minimum[axis] - point[axis];
        const double above = point[axis] - box.maximum[axis];
        if (below > nearest.height) nearest = Surface{below, -Vec3::Unit(axis), repulsorRadius};
        if (above > nearest.height) nearest = Surface{above, Vec3::Unit(axis), repulsorRadius};
    }
    visit(nearest);
}

template <class Visit>
void forEachSurface(const Sphere& sphere, const Vec3& point, double repulsorRadius, const Visit& visit) {
    const Vec3 away = point - sphere.center;
    const double distance = std::sqrt(squaredLength(away));
    const Vec3 normal = distance > 0.0 ? Vec3(away / distance) : Vec3(Vec3::UnitY());
    visit(Surface{distance - sphere.radius, normal, sphere.literalRepulsor ? sphere.radius : repulsorRadius});
}

/// A surface and a particle as a pair: the repulsor sits repulsorRadius behind the face.
struct Contact {
    PairConstants<double> constants;
    double distance = 0.0;    ///< particle to repulsor, at least the core distance, m
    double beyondCore = 0.0;  ///< how much deeper the particle is, m
};

Contact contactWith(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    Material repulsor;
    repulsor.repulsion = law.repulsion;
    repulsor.damping = law.dampingFactor * probe.dampingReach;
    repulsor.repulsionReach = 1.0;
    repulsor.dampingReach = 1.0;
    repulsor.coreFraction = law.coreFraction;
    Contact contact;
    contact.constants = pairConstants<double>(repulsor, probe.radius + surface.repulsorRadius);
    const double distance = surface.height + surface.repulsorRadius;
    contact.distance = std::max(distance, std::sqrt(contact.constants.coreSq));
    contact.beyondCore = contact.distance - distance;
    return contact;
}

constexpr PairTerms kRepulsorTerms{.attraction = false, .damping = true};

/// P = distance * normal and V = v of the particle. A particle deeper than the core distance feels the force at the
/// core: the half-space has no far side to be pushed out of.
Vec3 surfaceForce(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    const Contact contact = contactWith(surface, law, probe);
    const double approach = contact.distance * dot(probe.velocity, surface.normal);
    const double distanceSq = contact.distance * contact.distance;
    return contact.distance * pairCoefficient<kRepulsorTerms>(distanceSq, approach, contact.constants) * surface.normal;
}

double surfaceEnergy(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    const Contact contact = contactWith(surface, law, probe);
    const double distanceSq = contact.distance * contact.distance;
    const double force = contact.distance * pairCoefficient<kRepulsorTerms>(distanceSq, 0.0, contact.constants);
    return pairEnergy(contact.distance, contact.constants) + force * contact.beyondCore;
}

template <class Visit>
void forEachTouched(const Scenery& scenery, const Probe& probe, const Visit& visit) {
    const auto touch = [&](const Surface& surface) {
        if (surface.height < probe.radius) visit(surface);
    };
    for (const Collider& collider : scenery.colliders)
        std::visit([&](const auto& shape) { forEachSurface(shape, probe.position, scenery.law.radius, touch); },
                   collider);
}

}  // namespace

Vec3 contactForce(const Scenery& scenery, const Probe& probe) {
    Vec3 force = Vec3::Zero();
    forEachTouched(scenery, probe, [&](const Surface& surface) { force += surfaceForce(surface, scenery.law, probe); });
    return force;
}

double contactEnergy(const Scenery& scenery, const Probe& probe) {
    double energy = 0.0;
    forEachTouched(scenery, probe,
                   [&](const Surface& surface) { energy += surfaceEnergy(surface, scenery.law, probe); });
    return energy;
}

}  // namespace engine
