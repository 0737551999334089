// The squares of tiles that are drawn together, class by class. Used by the picture pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// What shaders/tile.vert reads of a square.
struct TileRow {
    std::int32_t column = 0;  ///< of its first tile
    std::int32_t row = 0;
    std::int32_t side = 1;       ///< tiles
    std::int32_t lineSlot = -1;  ///< place in PictureSamples::lines over 256, or -1
};

struct TileTable {
    std::vector<TileRow> rows;  ///< class by class
    std::vector<int> first;     ///< per class, its first row; then the number of all rows
};

/// Tiles along a side of llvmpipe's own tiles: a square of so many, all of one class, costs it little more than a
/// single.
inline constexpr int kSquareSide = 4;

/// classes: per tile, row by row, as tile_class.h has it; 0 for what is not drawn. lineSlots: per tile.
TileTable tileTable(std::span<const std::uint8_t> classes, int columns, std::span<const std::int32_t> lineSlots);

}  // namespace render
