// OpenEXR files of layers. OpenEXR may be missing from a build, and is loaded when it is first asked for. Called by
// picture_formats.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/layers.h"

namespace render {

/// View depth where nothing is seen, in an OpenEXR file, m. Chosen: what Blender writes; infinity would not survive a
/// filter.
inline constexpr float kNoDepthInExr = 1e10F;

/// The version of OpenEXR; empty if it is not there.
std::string openExrVersion();

/// @throws SystemError if OpenEXR is not there, with the reason
void requireOpenExr();

/// Encodes the layers color, points and ids as one OpenEXR file, compressed by ZIP: R, G, B, A (half floats, linear,
/// times alpha), Z (float, m; kNoDepthInExr where nothing is seen), N.X, N.Y, N.Z (float, world axes; 0 where nothing
/// is seen), id (unsigned integer, as Layers::ids). The same layers give the same bytes.
/// @throws SystemError if OpenEXR is not there
std::vector<std::uint8_t> encodeExr(PictureSize size, const Layers& layers);

}  // namespace render
