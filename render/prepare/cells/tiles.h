// Binning of items into the cells of a 2D grid, in a given order, so that a pixel tests only the few items near it. The
// same function bins spheres, balls and lines into the picture's tiles of 16 x 16 pixels, and shadow casters into the
// light's grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/bounds.h"
#include "render/picture/camera_frame.h"

namespace render {

inline constexpr int kTileSize =
    16;  ///< width and height of a tile in pixels; measured to be the fastest of 8, 16 and 32

inline constexpr std::size_t kTilePixels = kTileSize * kTileSize;

/// What a tile of the picture shows.
enum class TileKind : std::uint8_t {
    background,      ///< nothing but the background
    openGround,      ///< nothing but ground, out of reach of all shadows and with the whole sky visible
    occludedGround,  ///< nothing but ground that may be shadowed or see only a part of the sky
    mixed            ///< anything else, or several of these
};

/// Number of tiles that cover so many pixels of a row or column of the picture.
constexpr int tilesAlong(int pixels) {
    return (pixels + kTileSize - 1) / kTileSize;
}

/// A vector of three components for each pixel of a tile, component by component.
using TileVec3 = std::array<std::array<float, kTilePixels>, 3>;

/// Index of a cell of a 3D grid whose cells are stored with x running fastest.
inline std::size_t cellIndex(glm::ivec3 gridSize, int x, int y, int z) {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(gridSize.y) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(gridSize.x) +
           static_cast<std::size_t>(x);
}

/// A list of items for each cell, row by row, one list after another.
struct CellLists {
    int columns = 0;
    int rows = 0;
    /// Cell c has items[begin[c]] ... items[begin[c + 1] - 1]: one entry more than there are cells.
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> items;

    std::size_t cellIndex(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
    std::size_t cellCount() const { return begin.size() - 1; }
    std::span<const std::uint32_t> itemsOf(std::size_t cell) const {
        return std::span(items).subspan(begin[cell], begin[cell + 1] - begin[cell]);
    }
};

/// The top left corner of a tile, in pixels of the picture.
inline glm::vec2 tileCorner(const CellLists& tiles, std::size_t tile) {
    const auto columns = static_cast<std::size_t>(tiles.columns);
    return static_cast<float>(kTileSize) * glm::vec2(tile % columns, tile / columns);
}

/// An item to be listed in a rectangle of cells.
struct CellItem {
    std::uint32_t index = 0;  ///< number that is written to the lists of the cells
    Rect cells;               ///< cells that list the item; must lie within the grid
};

/// Makes the lists of items of all cells of a grid; each has the order of `items`.
/// @throws SystemError beyond 2^31 entries
CellLists binIntoCells(std::span<const CellItem> items, int columns, int rows);

/// The indices of the keys, ordered by rising key; equal keys keep their order.
std::vector<std::uint32_t> indicesByKey(std::span<const float> keys);

/// A sphere relative to a camera: in its view coordinates, or in world axes relative to its eye.
struct ViewSphere {
    glm::vec3 center{0.0F};
    float radius = 0.0F;
};

/// Bounds of the pixels that each sphere may touch, one pixel of margin included; an empty rectangle for a sphere
/// outside of the picture. A sphere that reaches the eye's plane, or nearly, may touch every pixel.
/// @param spheres  in view coordinates
std::vector<Rect> pixelBounds(const CameraFrame& frame, std::span<const ViewSphere> spheres);

/// The spheres of each tile from front to back, that is by the rising depth of their nearest point.
/// @param spheres  in view coordinates
/// @param pixels  pixelBounds() of the spheres
CellLists binToTiles(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<const Rect> pixels);

}  // namespace render
