// Where nozzles emit: points that fill discs, rings, boxes and lines, the order in which they take turns, and the
// particles of a drop. Called by scenes/; the simulation itself knows only the sites.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Two perpendicular unit vectors that span a plane.
struct PlaneAxes {
    Vec3 first = Vec3::UnitX();
    Vec3 second = Vec3::UnitZ();
};

/// Two axes of the plane that is perpendicular to a direction vector of any length; the x and z axes if the vector is
/// zero.
PlaneAxes axesAcross(const Vec3& direction);

/// Hexagonally packed sites of a disc-shaped nozzle around a center (m), in the plane perpendicular to the direction.
/// @param radius   largest distance from the center, m
/// @param spacing  distance between neighboring sites, m
std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// Evenly spaced sites on a circle around a center (m), in the plane perpendicular to the direction.
/// @param radius   of the circle, m
/// @param spacing  least distance between neighboring sites, m
std::vector<Vec3> ringSites(const Vec3& center, const Vec3& direction, double radius, double spacing);

/// Sites that fill an axis-aligned box around a center (m): a face-centered cubic lattice, hexagonally packed rows if
/// one edge is zero, and evenly spaced points if two are.
/// @param size     lengths of the edges, m
/// @param spacing  distance between neighboring sites, m; the least one on a line
std::vector<Vec3> boxSites(const Vec3& center, const Vec3& size, double spacing);

/// Evenly spaced sites from one point (m) to another, both included; the middle if they are closer than the spacing
/// (m).
std::vector<Vec3> lineSites(const Vec3& from, const Vec3& to, double spacing);

/// Sites in an order that makes an even jet where they emit one after another, the last followed by the first: any
/// stretch of the order is spread over the whole nozzle, and no slanted or helical layers form. Takes time in
/// proportion to the cube of the number of sites, at most a tenth of a second.
std::vector<Vec3> takingTurns(const std::vector<Vec3>& sites);

/// The points of a face-centered cubic lattice that form the roundest ball of so many points, around their mean, m.
/// @param spacing  distance of nearest neighbors, m
std::vector<Vec3> clusterPositions(std::size_t count, double spacing);

/// 1 - cos(a) for an angle of 0 to 180 degrees; the same bits on every machine.
double oneMinusCosine(double degrees);

}  // namespace engine
