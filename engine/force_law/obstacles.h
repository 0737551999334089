// Fixed obstacles (section 3.2 of the paper). A particle that touches one is repelled by a repulsor: a particle at rest
// behind the closest point of the surface, which acts on that particle alone. The shapes here are plain data;
// obstacle_surfaces.h computes their distance from a particle.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// A half-space: everything on the side that the normal points away from is solid.
struct Plane {
    Vec3 point = Vec3::Zero();    ///< m
    Vec3 normal = Vec3::UnitY();  ///< unit normal that points away from the solid side
};

/// The inside of an axis-aligned box: six planes that face inwards.
struct Container {
    Vec3 minimum = Vec3::Zero();  ///< m
    Vec3 maximum = Vec3::Zero();  ///< m
};

/// A solid axis-aligned box.
struct Box {
    Vec3 minimum = Vec3::Zero();  ///< m
    Vec3 maximum = Vec3::Zero();  ///< m
};

/// A solid sphere.
struct Sphere {
    Vec3 center = Vec3::Zero();    ///< m
    double radius = 0.5;           ///< m
    bool literalRepulsor = false;  ///< repulsor with the sphere's radius and center, as in the paper
};

using Obstacle = std::variant<Plane, Container, Box, Sphere>;

/// The constants of the force between particles and repulsors (section 3.2 of the paper), the same for all obstacles.
struct RepulsorLaw {
    double radius = 0.5;         ///< m
    double repulsion = 10.0;     ///< strength b1 of the repulsion, N m^4
    double dampingFactor = 5.0;  ///< b_d over the c_d of the particle's material, kg/s
    double coreFraction = 0.25;  ///< core distance, in rest lengths
};

struct Obstacles {
    std::vector<Obstacle> shapes;
    RepulsorLaw law;
};

/// Number of particles that a thread processes at a time in loops over the contacts of each particle.
std::size_t contactGrain(const Obstacles& obstacles);

/// The quantities of a particle on which its contacts with obstacles depend.
struct Probe {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double radius = 0.15;          ///< m
    double dampingReach = 1.0;     ///< damping reach c_d of the particle's material, in rest lengths
    double friction = 0.0;         ///< friction coefficient mu of the particle's material
};

/// Force of the obstacles on a particle, and the particle's energy at them.
struct ContactSums {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< energy of the conservative part of the force, J
};

/// Sums force and energy over all obstacles that a particle touches; zero where it touches none. Planes push along
/// their normal however deep the particle is. Source: section 3.2.
ContactSums sumContacts(const Obstacles& obstacles, const Probe& probe);

}  // namespace engine
