// What the samples of a tile's pixels show: one thing in most pixels, several in those that an outline crosses. Called
// by picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/field_picture.h"
#include "render/cpu/raster/line_list.h"
#include "render/cpu/raster/primary_hits.h"
#include "render/prepare/ground_tiles.h"

namespace render {

/// What the tiles of a picture may show.
struct TileContents {
    const Solids& solids;
    const FieldPicture* field;  ///< or null
    const LineList& lines;
    std::span<const std::uint8_t> boxes;  ///< per tile: 1 where a box may be seen
    std::span<const GroundTile> ground;   ///< per tile

    bool hasSpheres(std::size_t tile) const;
    bool hasLines(std::size_t tile) const;
    bool hasField(std::size_t tile) const { return field != nullptr && field->slots[tile] >= 0; }

    /// Whether all that a tile shows, but for lines, is background, or is ground.
    bool isBackground(std::size_t tile) const;
    bool isGround(std::size_t tile) const;

 private:
    bool isEmpty(std::size_t tile) const;
};

/// The places of the samples within a pixel, from its middle.
using SampleOffsets = std::span<const glm::vec2>;

/// A pixel that shows several things.
struct EdgePixel {
    std::uint8_t place;  ///< column + 16 row
    std::uint8_t count;  ///< of its things
};

/// One of them.
struct EdgeThing {
    std::int32_t seen;      ///< as first_hits.h has it
    std::uint32_t samples;  ///< that show it, a bit each
};

/// The edge pixels of a tile; their things in the same order.
struct TileEdges {
    std::vector<EdgePixel> pixels;
    std::vector<EdgeThing> things;
};

/// The samples of one tile.
class TileSamples {
 public:
    /// offsets: one, or kFourSamples.
    TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile);

    /// What pixels that show one thing show, row by row.
    std::span<const std::int32_t, kTilePixels> seen() const { return samples_[0].seen; }

    std::span<const TileRays> rays() const { return samples_; }

    /// Overwrites `edges`, whose memory is used again.
    void findEdges(TileEdges& edges) const;

 private:
    std::size_t fieldSlot() const { return static_cast<std::size_t>(contents_.field->slots[tile_]); }
    void look();
    bool fieldFills() const;
    bool isSpheresOnGround() const;
    void lookAtField();
    void addEdge(std::uint8_t place, TileEdges& edges) const;

    const TileContents& contents_;
    std::size_t tile_;
    std::array<TileRays, 4> rays_;
    std::span<TileRays> samples_;
};

}  // namespace render
