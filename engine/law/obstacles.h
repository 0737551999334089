// Fixed obstacles (section 3.2 of the paper). Each answers a particle that touches it with a repulsor: a particle at
// rest, seen by that particle alone, hidden behind the closest point of the surface.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Everything on the far side of the normal is solid.
struct Plane {
    Vec3 point = Vec3::Zero();    ///< m
    Vec3 normal = Vec3::UnitY();  ///< unit length, away from the solid side
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
    bool literalRepulsor = false;  ///< one repulsor of the sphere's own radius at its center, as the paper has it
};

using Obstacle = std::variant<Plane, Container, Box, Sphere>;

/// The constants of section 3.2, equal for all obstacles.
struct RepulsorLaw {
    double radius = 0.5;         ///< m
    double repulsion = 10.0;     ///< b1, N m^4
    double dampingFactor = 5.0;  ///< b_d = this times the c_d of the particle's material, kg/s
    double coreFraction = 0.25;  ///< the guard of the pair law, see Material::coreFraction
};

struct Obstacles {
    std::vector<Obstacle> shapes;
    RepulsorLaw law;
};

/// How many particles are worth a thread where each of them meets the obstacles, or cheap work if there are none.
std::size_t contactGrain(const Obstacles& obstacles);

/// What an obstacle sees of a particle.
struct Probe {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double radius = 0.15;          ///< m
    double dampingReach = 1.0;     ///< c_d of its material
    double friction = 0.0;         ///< mu of its material
};

/// Force of all obstacles on a particle, in newtons; zero where it touches none.
/// Source: section 3.2. Planes push along their fixed normal however deep the particle is.
Vec3 contactForce(const Obstacles& obstacles, const Probe& probe);

/// Energy of the conservative part of contactForce, in joules.
double contactEnergy(const Obstacles& obstacles, const Probe& probe);

struct ContactAnswer {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< J
};

/// Both for one walk over the surfaces.
ContactAnswer contactForceAndEnergy(const Obstacles& obstacles, const Probe& probe);

}  // namespace engine
