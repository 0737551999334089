// One hit of the metaball cast, packed to 16 bytes for the shaders. Written by metaball_frame.cpp, read by
// shaders/picture.frag.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/camera_frame.h"
#include "render/metaball_cast.h"

namespace render {

/// A point of the surface as shaders/picture.frag unpacks it.
struct FieldSample {
    std::uint32_t depthBits = 0;  ///< view depth, a float's bits; 0: no surface
    std::uint32_t normal = 0;     ///< octahedral, 16 + 16 bits, in world axes
    std::uint32_t color = 0;      ///< square roots, 11 + 11 + 10 bits
    std::uint32_t extra = 0;      ///< first of four more samples at the sub-pixel places; 0: none
};

/// Openness of ray k along the normal, against it and along the mirrored ray, 10 bits each.
std::uint32_t packedOpenness(const RayBlock& block, std::size_t k);

/// Packs ray k of a block that was cast from this camera.
FieldSample packedSample(const CameraFrame& frame, const RayBlock& block, std::size_t k);

}  // namespace render
