// Tiles of background and of ground that nothing dims look the same from picture to picture while the camera rests:
// what the target still holds is not drawn again. Used by the picture pass.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "render/tile_class.h"

namespace render {

/// Everything that such a tile's pixels are computed from.
using Backdrop = std::array<glm::vec4, 8>;

class KeptTiles {
 public:
    /// Begins a picture of so many tiles. Nothing is kept from one with another backdrop.
    void begin(const Backdrop& backdrop, std::size_t tileCount);

    /// Whether the tile still shows this, and notes that it will. A picture's tile is always drawn again.
    bool keeps(std::size_t tile, TileClass look);

 private:
    Backdrop backdrop_{};
    std::vector<TileClass> looks_;  // kept: nothing that is known
};

}  // namespace render
