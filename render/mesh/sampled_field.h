// A metaball field at the nodes of a lattice: near its surface alone, which an isosurface is taken of, or wherever
// there is any, which files of the field have. Room that no ball reaches takes no memory.
#pragma once

#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "render/mesh/ball_blocks.h"

namespace render {

/// Numbers at the nodes of a lattice.
struct SampledField {
    float outside = 1.0F;                             ///< value wherever no block is: out of reach of all balls
    std::vector<glm::ivec3> blocks;                   ///< blocks whose nodes have values of their own
    std::vector<std::unique_ptr<BlockNodes>> values;  ///< values at the nodes of each of `blocks`
    std::vector<glm::ivec3> inside;                   ///< other blocks, whose nodes have the value -outside
};

/// Samples a field near its surface: the threshold less the field, which is negative inside and positive outside. The
/// blocks are those that touch the surface and their neighbors, so that memory is proportional to the surface. The
/// result is the same for any number of threads.
SampledField sampleNearSurface(const BallBlocks& balls, float threshold);

/// Samples a field in all blocks where it is above 0 somewhere; outside of them it is 0. The result is the same for any
/// number of threads.
SampledField sampleWhole(const BallBlocks& balls);

}  // namespace render
