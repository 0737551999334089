// What a cloud of particles looks like from afar: where it is, how wide, how high. Once a motion is chaotic, runs are
// compared by these four numbers, because positions of single particles say nothing any more.
#pragma once

#include "engine/state/particles.h"

namespace studies {

struct BulkStatistics {
    engine::Vec3 center = engine::Vec3::Zero();  ///< of mass, m
    double gyration = 0.0;                       ///< radius of gyration about it, weighted by mass, m
    double r90 = 0.0;                            ///< radius about the center that holds 90 % of the particles, m
    double z90 = 0.0;                            ///< height that 90 % of the particles do not exceed, m
};

/// Zeros without particles.
BulkStatistics bulkStatistics(const engine::Particles& particles);

/// Largest of the four differences, in meters; that of the centers is a distance.
double largestDifference(const BulkStatistics& a, const BulkStatistics& b);

}  // namespace studies
