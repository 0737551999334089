// Hits of the metaball cast, packed to 16 bytes for the shaders. Written by metaball_frame.cpp and outline_rays.cpp,
// read by shaders/surface.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/camera_frame.h"
#include "render/metaball_cast.h"

namespace render {

/// A point of the surface as shaders/surface.glsl unpacks it.
struct FieldSample {
    std::uint32_t depthBits = 0;  ///< view depth, a float's bits; 0: no surface
    std::uint32_t normal = 0;     ///< octahedral, 16 + 16 bits, in world axes
    std::uint32_t color = 0;      ///< square roots, 11 + 11 + 10 bits
    std::uint32_t extra = 0;      ///< first of four more samples at the sub-pixel places; 0: none
};

struct FieldPicture {
    std::vector<FieldSample> samples;  ///< 256 a slot, row by row, then the extra samples
    std::vector<std::uint32_t> open;   ///< of each sample, as packBlock() has it; empty without
    std::vector<std::int32_t> slots;   ///< per tile; -1 where nothing of the surface is seen
};

/// A block's samples, and the openness of each along the normal, against it and along the mirrored ray, 10 bits each.
struct PackedBlock {
    alignas(64) std::array<FieldSample, kBlockRays> samples;
    alignas(64) std::array<std::uint32_t, kBlockRays> open;
};

/// Packs the rays of a block that was cast from this camera; rays beyond the block's count are packed to nothing of
/// use. Holds:  the same bits on every instruction set.
void packBlock(const CameraFrame& frame, const RayBlock& block, bool openness, PackedBlock& packed);

}  // namespace render
