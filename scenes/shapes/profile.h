// Profiles of solids of revolution as a scene gives them: few points, of which corners are rounded, or through which a
// curve is drawn. The results are the chains of points that engine::Revolution turns around its axis.
#pragma once

#include <string>
#include <vector>

#include "engine/shapes/revolution.h"

namespace scenes {

using Profile = std::vector<engine::ProfilePoint>;

/// A profile before its corners are rounded.
struct ProfileSpec {
    Profile points;          ///< in order, m
    bool isClosed = true;    ///< whether the last point is joined to the first
    double thickness = 0.0;  ///< of the wall along the chain, m; 0 for the solid that a closed profile encloses
    bool isSmooth = false;   ///< whether a curve goes through the points, instead of straight lines
    /// Radius of inner corners, m. For a wall it is that of its middle line, so that the inner corner has half a
    /// thickness less. Negative: the thickness of the wall, or a fiftieth of the size of a solid.
    double fillet = -1.0;
};

/// Twice the area of a polygon (m^2), positive if its points run counterclockwise, from the radius to the height.
double twiceArea(const Profile& points);

/// What is wrong with a profile, as a sentence without its beginning, such as "has no area"; empty if nothing is.
std::string profileProblem(const ProfileSpec& spec);

/// The profile whose inner corners are rounded by arcs, or whose points are joined by a curve, in steps of at most 3
/// degrees. A corner is rounded as far as half of its shorter edge allows. A point on the axis at which one edge ends
/// is a corner with its mirror image. Outer corners of solids stay sharp: the distance from them is smooth outside.
Profile refinedProfile(const ProfileSpec& spec);

/// The solid of revolution of a profile without problems.
engine::Revolution revolutionOf(const ProfileSpec& spec);

}  // namespace scenes
