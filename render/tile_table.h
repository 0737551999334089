// The squares of tiles that are drawn together, class by class. Used by the picture pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/tile_class.h"

namespace render {

/// What shaders/tile.vert reads of a square.
struct TileRow {
    std::int32_t column = 0;  ///< of its first tile
    std::int32_t row = 0;
    std::int32_t side = 1;    ///< tiles
    std::int32_t unused = 0;  ///< a texel has four numbers
};

struct TileTable {
    std::vector<TileRow> rows;  ///< class by class
    std::vector<int> first;     ///< per class, its first row; then the number of all rows
};

/// Tiles along a side of llvmpipe's own tiles: a square of so many, all of one class, costs it little more than a
/// single.
inline constexpr int kSquareSide = 4;

/// classes: per tile, row by row.
TileTable tileTable(std::span<const TileClass> classes, int columns);

}  // namespace render
