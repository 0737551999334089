// What the samples of a tile's pixels hit: one thing in most pixels, several in those that an outline crosses. Called
// by picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/cpu/raster/lines.h"
#include "render/cpu/raster/primary_hits.h"
#include "render/prepare/cells/tiles.h"

namespace render {

/// What the tiles of a picture may show.
struct TileContents {
    SolidGeometry geometry;
    const MetaballHits* metaballs;  ///< null without metaballs
    const LineList& lines;
    std::span<const TileKind> ground;  ///< per tile: what it shows as long as nothing stands before the ground

    bool hasSpheres(std::size_t tile) const { return !geometry.tiles->itemsOf(tile).empty(); }
    bool hasBoxes(std::size_t tile) const { return !geometry.boxTiles->itemsOf(tile).empty(); }
    bool hasLines(std::size_t tile) const { return !lines.tiles.itemsOf(tile).empty(); }
    bool hasMeshes(std::size_t tile) const;
    bool hasMetaballs(std::size_t tile) const { return metaballs != nullptr && metaballs->slots[tile] >= 0; }
    TileKind kindOf(std::size_t tile) const;
};

/// Offsets of the samples of a pixel from the pixel's middle, in pixels: a single one, or kFourSamples.
using SampleOffsets = std::span<const glm::vec2>;

/// A pixel whose samples hit several things.
struct EdgePixel {
    std::uint8_t pixel;     ///< column + 16 row within the tile
    std::uint8_t hitCount;  ///< number of different things that the pixel's samples hit
};

/// One of the things that the samples of an edge pixel hit.
struct EdgeHit {
    std::int32_t hitId;        ///< what the samples hit, see primary_hits.h
    std::uint32_t sampleMask;  ///< one bit for each of the pixel's samples, set if the sample hits this thing
};

/// The edge pixels of a tile, and what their samples hit, one pixel after another.
struct TileEdges {
    std::vector<EdgePixel> pixels;
    std::vector<EdgeHit> hits;
};

/// The samples of one tile.
class TileSamples {
 public:
    TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile);

    /// What the first sample of each pixel hits, row by row, as in primary_hits.h. In a pixel that no outline crosses,
    /// all samples hit the same.
    std::span<const std::int32_t, kTilePixels> hitIds() const { return samples_[0].hitId; }

    std::span<const TileRays> rays() const { return samples_; }

    /// Finds the pixels whose samples hit different things.
    /// @param edges  overwritten; its memory is reused
    void findEdges(TileEdges& edges) const;

 private:
    std::size_t slot() const { return static_cast<std::size_t>(contents_.metaballs->slots[tile_]); }
    void addMetaballs();
    void addEdge(std::uint8_t pixel, TileEdges& edges) const;

    const TileContents& contents_;
    std::size_t tile_;
    std::array<TileRays, 4> rays_;
    std::span<TileRays> samples_;
};

}  // namespace render
