// Measures how much two states of one scene differ: particle by particle as long as the motion is predictable, and by
// bulk statistics once it is chaotic and single positions no longer mean anything. Used by the studies of accuracy and
// stability.
#pragma once

#include <cstddef>
#include <limits>

#include "engine/state/particles.h"

namespace studies {

/// The error of states that cannot be compared, and the value of an observable after a failure.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Position and extent of a set of particles.
struct BulkStatistics {
    engine::Vec3 center = engine::Vec3::Zero();  ///< center of mass, m
    double gyration = 0.0;                       ///< mass-weighted radius of gyration about the center, m
    double r90 = 0.0;                            ///< radius about the center that holds 90 % of the particles, m
    double z90 = 0.0;                            ///< height that 90 % of the particles do not exceed, m
};

/// Position and extent of the particles; all numbers are 0 if there are none.
BulkStatistics bulkStatistics(const engine::Particles& particles);

/// The largest difference of the four statistics of two sets of particles, m; that of the centers is their distance.
double largestDifference(const BulkStatistics& a, const BulkStatistics& b);

/// Distances between corresponding particles of two states, each divided by the particle's radius.
struct PositionError {
    double rms = 0.0;          ///< root mean square distance, radii
    double largest = 0.0;      ///< largest distance, radii
    std::size_t compared = 0;  ///< number of particles compared
};

/// Whether two runs have the same particles, born at the same times.
bool sameBirths(const engine::Particles& a, const engine::Particles& b);

/// The distances between particles of the same index in two runs that began with a common state.
/// @param common  number of particles in the common state. Particles born later are compared only if both runs have the
///                same ones at the same times: a single birth that differs shifts all later indices.
/// @return  infinite errors if the particles differ and common is 0
PositionError positionError(const engine::Particles& particles, const engine::Particles& reference, std::size_t common);

/// The particles, each moved along every axis by up to `radii` times its radius: pseudorandom, the same in every call.
engine::Particles displaced(engine::Particles particles, double radii);

/// Sums of the magnitudes of the momenta of all particles, the scale for drifts of the total momenta.
struct MomentumScale {
    double linear = 0.0;   ///< sum of |p|, kg m/s
    double angular = 0.0;  ///< sum of |x x p|, kg m^2/s
};

MomentumScale momentumScale(const engine::Particles& particles);

}  // namespace studies
