// The colors of a picture's pixels, and the points of surfaces that they show, tile by tile. Called by the picture
// pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/picture_samples.h"
#include "render/cpu/shading/shade.h"
#include "render/cpu/shading/tile_class.h"
#include "render/picture/image.h"

namespace render {

/// One picture that is to be colored.
struct PictureJob {
    const TileContents& contents;
    SampleOffsets offsets;  ///< one, or kFourSamples
    const Surfaces& surfaces;
    const Obstruction* obstruction;  ///< null where nothing dims anything
    const Shading& shading;
};

/// pixels: row by row, whole tiles of them; only those of tiles of pictures are written. classes: one a tile.
void colorPixels(const PictureJob& job, std::span<PixelColor> pixels, std::span<TileClass> classes);

/// The same of one of several jobs, whose tiles are of the same classes; sums: along kZCurve, a tile each.
void addColors(const PictureJob& job, std::span<PointColors> sums, std::span<TileClass> classes);

/// The mean of so many.
void meanColors(int jobs, std::span<PointColors> sums, std::span<const TileClass> classes, const CellLists& tiles,
                std::span<PixelColor> pixels);

/// What the job's first sample of each pixel of the picture meets, row by row.
std::vector<VisiblePoint> visiblePoints(const PictureJob& job);

}  // namespace render
