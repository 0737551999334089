// Binning: which items touch which cell of a grid, in a wanted order. One routine serves the picture's 16-pixel tiles,
// the light's grid and the lines, so that a pixel only ever walks a short list.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/camera_frame.h"

namespace render {

inline constexpr int kTileSize = 16;  ///< pixels; measured best among 8, 16 and 32 in the prototypes

inline constexpr std::size_t kTilePixels = kTileSize * kTileSize;

/// Lists of items per cell, row by row, one after another.
struct CellLists {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint32_t> begin;  ///< cells + 1 entries: cell c holds items[begin[c]] ... items[begin[c + 1] - 1]
    std::vector<std::uint32_t> items;

    std::size_t cellIndex(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
};

/// The top left corner of a tile in pixels of the picture.
inline glm::vec2 tileCorner(const CellLists& tiles, std::size_t tile) {
    const auto columns = static_cast<std::size_t>(tiles.columns);
    return static_cast<float>(kTileSize) * glm::vec2(tile % columns, tile / columns);
}

/// An item's place in the grid.
struct CellItem {
    std::uint32_t index = 0;  ///< what is written to the lists
    Rect cells;               ///< within the grid
};

/// Lists every cell's items in the order of `items`.
/// Holds:  the result depends on nothing but the arguments; throws SystemError beyond 2^31 entries.
CellLists binIntoCells(std::span<const CellItem> items, int columns, int rows);

/// Order of places by rising key, equal keys by place.
std::vector<std::uint32_t> indicesByKey(std::span<const float> keys);

/// A sphere in some camera's view coordinates.
struct ViewSphere {
    glm::vec3 center{0.0F};
    float radius = 0.0F;
};

/// The pixels that each sphere may touch, one pixel of margin included; none (an empty rectangle) where it is out of
/// sight. One that reaches the eye's plane, or almost, may touch every pixel.
std::vector<Rect> pixelBounds(const CameraFrame& frame, std::span<const ViewSphere> spheres);

/// The spheres of each 16-pixel tile, front to back: by rising (center's depth - radius). pixels: as touchedPixels has
/// them.
CellLists binToTiles(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<const Rect> pixels);

}  // namespace render
