// What the samples of a picture's pixels show: one thing in most pixels, several in those that an outline crosses. Made
// on the CPU for shaders/picture.frag and shaders/edges.frag. Called by the picture pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/field_sample.h"
#include "render/first_hits.h"
#include "render/ground_tiles.h"
#include "render/light_reach.h"
#include "render/line_list.h"
#include "render/surface_points.h"

namespace render {

/// One thing that a pixel shows.
struct Fragment {
    std::int32_t seen;   ///< as first_hits.h has it
    std::int32_t reach;  ///< bits 0 to 3: samples that show it; above: shares as light_reach.h has them
};

/// A pixel that shows several things.
struct EdgePixel {
    std::int32_t place = 0;  ///< column + 65536 row
    std::int32_t first = 0;  ///< of its fragments
    std::int32_t count = 0;
    std::int32_t line = -1;  ///< place in PictureSamples::lines, or -1
};

/// What a tile may show besides spheres; what the samples are taken of.
struct TileContents {
    const Solids& solids;
    const FieldPicture* field;  ///< or null
    const LineList& lines;
    std::span<const std::uint8_t> boxes;  ///< per tile: 1 where a box may be seen
    std::span<const GroundTile> ground;   ///< per tile
    const Surfaces& surfaces;
    const Obstruction* obstruction = nullptr;  ///< null where nothing dims anything
    bool plainToo = false;                     ///< the pixels of plain tiles are asked for
};

/// The edge pixels of one tile; places of fragments are counted from the tile's first.
struct TileEdges {
    std::vector<EdgePixel> pixels;
    std::vector<Fragment> fragments;
    int classBits = 0;
};

struct PictureSamples {
    std::vector<std::uint8_t> classes;    ///< per tile, as tile_class.h has it; what edge pixels show left out
    std::vector<EdgePixel> edges;         ///< those with as many fragments side by side
    std::vector<Fragment> fragments;      ///< edge pixel after edge pixel
    std::uint8_t edgeClass = 0;           ///< what edge pixels show
    std::vector<glm::vec4> lines;         ///< 256 a tile that has lines: what line_cover.h lays over its pixels
    std::vector<std::int32_t> lineSlots;  ///< per tile: its place in `lines` over 256, or -1
    std::vector<TileEdges> tileEdges;     ///< what edges and fragments were put together from
};

/// The places of the samples within a pixel, from its middle.
using SampleOffsets = std::span<const glm::vec2>;

/// offsets: one, or kFourSamples. pixels: 256 a tile, row by row; written, never read; those of edge pixels and,
/// unless they are asked for, of plain tiles become nothing of use. Overwrites `samples`, whose memory is used again.
void takeSamples(const TileContents& contents, SampleOffsets offsets, std::span<Fragment> pixels,
                 PictureSamples& samples);

}  // namespace render
