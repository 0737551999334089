// The colors of a picture's pixels, and the surface points that they show, tile by tile. Called by the picture pass.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/shading/shade.h"
#include "render/cpu/tile_samples.h"
#include "render/picture/image.h"

namespace render {

/// Everything that the pixels of one picture are colored from.
struct PictureJob {
    const TileContents& contents;
    SampleOffsets offsets;
    const ShadingGeometry& geometry;
    const Occluders* occluders;  ///< null where nothing casts shadows or occludes the sky
    const Shading& shading;
};

/// A picture that is the mean of several, which are colored one after another.
struct PictureMean {
    std::size_t index = 0;  ///< of this picture
    std::size_t count = 1;
    std::vector<PointColors>& sums;  ///< of the pictures so far, a tile each; not used for one picture
};

/// Colors the pixels of a picture, or adds them to the mean, of which the last picture writes the pixels.
/// @param pixels  of whole tiles, row by row
void colorPixels(const PictureJob& job, const PictureMean& mean, std::span<PixelColor> pixels);

/// What the job's first sample of each pixel of the picture hits, row by row.
std::vector<VisiblePoint> visiblePoints(const PictureJob& job);

}  // namespace render
