// A metaball field at the nodes of a lattice, near its surface alone: what an isosurface is taken of. The memory is
// proportional to the surface, not to the volume inside or to the room around it.
#pragma once

#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "render/mesh/ball_blocks.h"

namespace render {

/// Values are the threshold less the field: negative inside, positive outside.
struct SampledField {
    float outside = 1.0F;                             ///< value wherever no block is: out of reach of all balls
    std::vector<glm::ivec3> blocks;                   ///< blocks that touch the surface or a block that does
    std::vector<std::unique_ptr<BlockNodes>> values;  ///< values at the nodes of each of `blocks`
    std::vector<glm::ivec3> inside;                   ///< other blocks that lie inside as a whole
};

/// Samples a field near its surface. The result is the same for any number of threads.
SampledField sampleNearSurface(const BallBlocks& balls, float threshold);

}  // namespace render
