// Fixed obstacles: their shapes, their surfaces, and how they answer particles. The shapes are plain data;
// obstacle_surfaces.h computes their distance from a particle, contact.h the force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/obstacles/bounding_box_tree.h"

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

/// The box around an obstacle; none around a plane, which has no end.
std::optional<BoundingBox> boundsOf(const Obstacle& obstacle);

/// The constants of the force between particles and repulsors (section 3.2 of the paper), the same for all obstacles.
struct RepulsorLaw {
    double radius = 0.5;         ///< m
    double repulsion = 10.0;     ///< strength b1 of the repulsion, N m^4
    double dampingFactor = 5.0;  ///< b_d over the c_d of the particle's material, kg/s
    double coreFraction = 0.25;  ///< core distance, in rest lengths
};

/// How particles rebound from a scaled wall.
struct Rebound {
    double restitution = 0.2;                  ///< speed after a rebound over the speed before, 0 to 1
    double dampingRatio = 0.4559498107691261;  ///< zeta of contact.h, 0 to 1, which makes that restitution
    /// Whether the damping of the particle's material is added, so that what is viscous rebounds less.
    bool isDampedByMaterial = true;
};

/// Rebounds with this restitution exactly, 0 to 1, whatever the material.
Rebound reboundWith(double restitution);

/// How the surface of an obstacle answers particles under the scaled wall law.
struct WallSurface {
    Rebound rebound = {};
    std::optional<double> friction = {};  ///< coefficient mu; that of the particle's material where it is left out
    double adhesion = 0.0;                ///< stress with which the surface holds particles that touch it, N/m^2
};

/// The laws of the force between particles and obstacles; contact.h has the formulas.
enum class WallLaw {
    paper,  ///< the repulsors of section 3.2 of the paper: one stiffness for particles of any material and size
    scaled  ///< stiffness and damping follow the particle's material, mass and radius; no center passes the surface
};

/// Finds the obstacles near a point. Empty for the paper's walls, whose scenes have few, and where looking at all is
/// faster.
struct ObstacleIndex {
    BoundingBoxTree solids;                 ///< of the boxes and spheres
    std::vector<std::uint32_t> obstacleOf;  ///< the obstacle that each box of the tree stands for
    std::vector<std::uint32_t> unbounded;   ///< planes and containers: what they are the surface of has no end
};

struct Obstacles {
    std::vector<Obstacle> shapes;
    ObstacleIndex index;  ///< of the shapes; start() fills it in
    WallLaw wall = WallLaw::paper;
    RepulsorLaw law;  ///< of the paper's walls
    std::vector<WallSurface>
        surfaces;          ///< of the shapes, in their order, for scaled walls; default where there is none
    double gravity = 0.0;  ///< size of the gravity under which particles lie on scaled walls, m/s^2
};

/// The index of these shapes, which are named by their positions in the vector.
ObstacleIndex indexOf(const Obstacles& obstacles);

/// Number of particles that a thread processes at a time in loops over the contacts of each particle.
std::size_t contactGrain(const Obstacles& obstacles);

/// A particle as its contacts with obstacles see it.
struct Probe {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double radius = 0.15;          ///< m
    double dampingReach = 1.0;     ///< damping reach c_d of the particle's material, in rest lengths
    double friction = 0.0;         ///< friction coefficient mu of the particle's material
    double mass = 1.0;             ///< kg
    double repulsion = 0.01;       ///< strength b1 of the repulsion of the particle's material, N m^4
    double damping = 1.0;          ///< damping coefficient b_d of the particle's material, kg/s
};

/// Force of the obstacles on a particle, and the particle's energy at them.
struct ContactSums {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< energy of the conservative part of the force, J
};

/// Sums force and energy over all obstacles that a particle touches; zero where it touches none. Planes push along
/// their normal however deep the particle is.
ContactSums sumContacts(const Obstacles& obstacles, const Probe& probe);

}  // namespace engine
