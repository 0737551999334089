// The ray cast of the metaball field: where rays first meet the surface, on the CPU, as many rays at a time as the
// machine has lanes. Called for each tile of the picture and of the light's depth map.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/tiles.h"

namespace render {

/// A ball of the field in the camera's view coordinates.
struct FieldBall {
    glm::vec3 center{0.0F};
    float reach = 1.0F;  ///< where its kernel ends, m
    float peak = 1.0F;   ///< square root of its weight, so that its share of the field is (peak - d^2 slope^2)^2
    float slope = 1.0F;  ///< fourth root of its weight over its reach
};

/// What it lends to the surface around it.
struct BallLook {
    glm::vec3 color{0.0F};
    SkyVisibility open = kUnoccluded;
};

/// What all rays of one picture share.
struct FieldCast {
    CameraFrame frame;
    std::span<const FieldBall> balls;
    std::span<const BallLook> looks;   ///< one a ball; or none, which leaves normal, color and open unwritten
    const CellLists* tiles = nullptr;  ///< of the balls' reaches, front to back
    float threshold = 0.5F;
    float step = 0.05F;          ///< view depth between samples of the field, m
    bool skyVisibility = false;  ///< writes open
};

inline constexpr std::size_t kBlockRays = 256;

/// Rays in (pixels of the picture), hits out; a structure of arrays for the lanes.
struct RayBlock {
    alignas(64) std::array<float, kBlockRays> x;
    alignas(64) std::array<float, kBlockRays> y;
    alignas(64) std::array<float, kBlockRays> from;  ///< view depths between which the surface is looked for
    alignas(64) std::array<float, kBlockRays> to;
    std::size_t count = 0;
    alignas(64) std::array<float, kBlockRays> depth;                  ///< view depth of the hit; negative: none
    alignas(64) std::array<float, kBlockRays> most;                   ///< the greatest sample of the field on the way
    alignas(64) std::array<std::array<float, kBlockRays>, 3> normal;  ///< in view coordinates, unit length
    alignas(64) std::array<std::array<float, kBlockRays>, 3> color;
    /// Along the normal, against it, and along the mirrored ray; where FieldCast::openness.
    alignas(64) std::array<std::array<float, kBlockRays>, 3> open;
};

/// Casts the rays of a block, all within one tile.
/// Holds:  a ray's result depends on its own position and limits and on the tile alone, bit for bit: neither on the
/// other rays of the block
///         nor on the number of lanes, because the samples stand on a grid common to the tile, a ball out of a ray's
///         reach adds exactly 0, and multiplications and additions are never fused.
void castBlock(const FieldCast& cast, std::size_t tile, RayBlock& block);

/// Name of the instruction set that castBlock uses on this machine, e.g. "AVX2". Its results are the same on each.
const char* castInstructionSet();

}  // namespace render
