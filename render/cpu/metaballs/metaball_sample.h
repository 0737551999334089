// Hits of the metaball cast, packed to 16 bytes. Written by metaball_frame.cpp and outline_rays.cpp, read by
// surface_points.cpp.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/picture/camera_frame.h"

namespace render {

/// A point of the surface.
struct FieldSample {
    std::uint32_t depthBits;  ///< view depth, a float's bits; 0: no surface
    std::uint32_t normal;     ///< octahedral, 16 + 16 bits, in world axes
    std::uint32_t color;      ///< square roots, 11 + 11 + 10 bits
    std::uint32_t open;       ///< openness along the normal, against it and along the mirrored ray, 10 bits each

    float depth() const { return std::bit_cast<float>(depthBits); }
};

using PackedBlock = std::array<FieldSample, kBlockRays>;

/// Packs the rays of a block that was cast from this camera, openness as 0 where it is not asked for. packed: with room
/// for kBlockRays; those beyond the block's count are packed to nothing of use. Holds:  the same bits on every
/// instruction set.
void packBlock(const CameraFrame& frame, const RayBlock& block, bool skyVisibility, FieldSample* packed);

}  // namespace render
