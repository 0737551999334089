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
#include "render/cpu/shading/ground_tiles.h"

namespace render {

/// What the tiles of a picture may show.
struct TileContents {
    SolidGeometry geometry;
    const MetaballHits* metaballs;  ///< null if there are none
    const LineList& lines;
    std::span<const std::uint8_t> boxes;  ///< per tile: 1 where a box may be seen
    std::span<const GroundTile> ground;   ///< per tile

    bool hasSpheres(std::size_t tile) const;
    bool hasLines(std::size_t tile) const;
    bool hasMetaballs(std::size_t tile) const { return metaballs != nullptr && metaballs->slots[tile] >= 0; }
    TileKind kindOf(std::size_t tile) const;
};

/// Positions of the samples within a pixel, from its middle: one, or kFourSamples.
using SampleOffsets = std::span<const glm::vec2>;

/// A pixel whose samples hit several things.
struct EdgePixel {
    std::uint8_t pixel;     ///< column + 16 row
    std::uint8_t hitCount;  ///< number of different things that its samples hit
};

struct EdgeHit {
    std::int32_t hitId;        ///< see primary_hits.h
    std::uint32_t sampleMask;  ///< a bit for each sample that hits it
};

/// The edge pixels of a tile, and their hits in the same order.
struct TileEdges {
    std::vector<EdgePixel> pixels;
    std::vector<EdgeHit> hits;
};

/// The samples of one tile.
class TileSamples {
 public:
    TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile);

    /// What the first sample of each pixel hits, row by row: in pixels without an edge, what all samples hit.
    std::span<const std::int32_t, kTilePixels> hitIds() const { return samples_[0].hitId; }

    std::span<const TileRays> rays() const { return samples_; }

    /// Overwrites `edges`, whose memory is reused.
    void findEdges(TileEdges& edges) const;

 private:
    std::size_t slot() const { return static_cast<std::size_t>(contents_.metaballs->slots[tile_]); }
    void findHits();
    bool isFilledByMetaballs() const;
    void addMetaballs();
    void addEdge(std::uint8_t pixel, TileEdges& edges) const;

    const TileContents& contents_;
    std::size_t tile_;
    std::array<TileRays, 4> rays_;
    std::span<TileRays> samples_;
};

}  // namespace render
