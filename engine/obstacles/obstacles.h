// Obstacles: their shapes, their surfaces, how they move, and how they answer particles. The shapes are plain data;
// obstacle_surfaces.h computes their distance from a particle, contact.h the force.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/obstacles/bounding_box_tree.h"
#include "engine/obstacles/contact_loads.h"
#include "engine/obstacles/motion.h"
#include "engine/shapes/distance_grid.h"
#include "engine/shapes/revolution.h"

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

/// A solid that is known by the signed distance of any point from its surface.
template <class Distances>
struct DistanceSolid {
    std::shared_ptr<const Distances> distances;  ///< in coordinates of their own
    Vec3 origin = Vec3::Zero();                  ///< of these coordinates, m
    BoundingBox bounds;                          ///< of the solid, m
    double thickness = 0.0;                      ///< at the thinnest place, m

    SignedDistance at(const Vec3& point) const { return distances->at(point - origin); }
};

/// A solid of revolution around an axis parallel to y through its origin.
using RevolutionSolid = DistanceSolid<Revolution>;

/// A solid bounded by a mesh, from distances on a grid.
using MeshSolid = DistanceSolid<DistanceGrid>;

using Obstacle = std::variant<Plane, Container, Box, Sphere, RevolutionSolid, MeshSolid>;

/// A solid of revolution with this origin (m).
RevolutionSolid revolutionSolid(Revolution revolution, const Vec3& origin);

/// The solid of a distance grid with this origin (m).
MeshSolid meshSolid(DistanceGrid grid, const Vec3& origin);

/// The box around a shape, in its own coordinates; none around a plane, which has no end.
std::optional<BoundingBox> boundsOf(const Obstacle& obstacle);

/// The box in the scene around a box in the coordinates of a shape that has this pose.
BoundingBox boundsIn(const Pose& pose, const BoundingBox& box);

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
    double wetting = 0.0;                 ///< 1 + the cosine of the contact angle, 0 to 2; see contact.h
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
    /// Those that are looked at everywhere: planes and containers, whose solid has no end, and what is turned or moves.
    std::vector<std::uint32_t> unbounded;
    bool isWetted = false;  ///< whether a surface pulls on liquids, and so acts from further away
};

/// The poses of all obstacles at a time; kept, because most particles ask for the same moment.
struct PosesAt {
    double time = std::numeric_limits<double>::quiet_NaN();  ///< s
    std::vector<Pose> poses;
};

/// Where obstacles are in a step, so that particles need not look for those that do not come near them.
struct PlacesInStep {
    std::array<PosesAt, 2> ends;  ///< at the start and at the end of the step
    /// What contains each obstacle throughout the step, m; without bounds for those that have no end or do not move.
    std::vector<BoundingBox> swept;
    std::vector<std::uint32_t> inMotion;  ///< those that move or are taken away, of which there mostly are few

    /// Whether a time (s) is in the step.
    bool include(double time) const { return time >= ends[0].time && time <= ends[1].time; }
};

struct Obstacles {
    std::vector<Obstacle> shapes;
    ObstacleIndex index;  ///< of the shapes; start() fills it in
    WallLaw wall = WallLaw::paper;
    RepulsorLaw law;  ///< of the paper's walls
    std::vector<WallSurface>
        surfaces;          ///< of the shapes, in their order, for scaled walls; default where there is none
    double gravity = 0.0;  ///< size of the gravity under which particles lie on scaled walls, m/s^2
    /// Of the shapes, in their order; empty where all shapes stay where they are given. Scaled walls alone may move.
    std::vector<Motion> motions;
    /// For each shape whether its loads are recorded; empty where none are. Those of obstacles in motion must be, since
    /// the audit of steps needs their work.
    std::vector<bool> areRecorded;
    PlacesInStep kept;  ///< of the present step; place() fills it in
};

/// Whether an obstacle, given by its index, is turned or moves.
inline bool isPlaced(const Obstacles& obstacles, std::size_t obstacle) {
    return !obstacles.motions.empty() && !obstacles.motions[obstacle].isIdentity();
}

/// Has the loads of all obstacles in motion recorded.
void recordInMotion(Obstacles& obstacles);

/// Whether any obstacle moves or is taken away.
bool areInMotion(const Obstacles& obstacles);

/// Whether the loads of an obstacle, given by its index, are recorded.
inline bool isRecorded(const Obstacles& obstacles, std::size_t obstacle) {
    return !obstacles.areRecorded.empty() && obstacles.areRecorded[obstacle];
}

/// Keeps where the obstacles are from the start to the end of a step (s), in which particles are about to be moved.
void place(Obstacles& obstacles, double from, double to);

/// The pose of an obstacle, given by its index, at a time (s).
inline Pose poseOf(const Obstacles& obstacles, std::size_t obstacle, double time) {
    for (const PosesAt& end : obstacles.kept.ends)
        if (end.time == time) return end.poses[obstacle];
    const Motion& motion = obstacles.motions[obstacle];
    if (!obstacles.kept.swept.empty() && motion.isAtRest()) return obstacles.kept.ends[0].poses[obstacle];
    return poseAt(motion, time);
}

/// Velocity at a time (s) of an obstacle's material at a point of the scene, m/s.
inline Vec3 velocityOf(const Obstacles& obstacles, std::size_t obstacle, double time, const Vec3& point) {
    for (const PosesAt& end : obstacles.kept.ends)
        if (end.time == time) return end.poses[obstacle].velocityAt(point);
    return velocityAt(obstacles.motions[obstacle], time, point);
}

/// The point about which an obstacle's torque is taken, at a time (s): its pivot, m.
Vec3 pivotAt(const Obstacles& obstacles, std::size_t obstacle, double time);

/// An upper bound on the speed of the surfaces of all obstacles between two times (s), m/s; infinite where something
/// without end turns.
double fastestSurface(const Obstacles& obstacles, double from, double to);

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
    double time = 0.0;             ///< s
    double cohesion = 0.0;         ///< surface tension of the particle's material, N/m
};

/// Force of the obstacles on a particle, and the particle's energy at them.
struct ContactSums {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< energy of the conservative part of the force, J
};

/// Sums force and energy over all obstacles that a particle touches; zero where it touches none. Planes push along
/// their normal however deep the particle is.
/// @param loads    where the loads are recorded, for obstacles of which they are; may be null
/// @param seconds  for which the force acts, s; for the loads
ContactSums sumContacts(const Obstacles& obstacles, const Probe& probe, ContactLoads* loads = nullptr,
                        double seconds = 0.0);

}  // namespace engine
