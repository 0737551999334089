// Classes of tiles, by how their pixels are found. Used by the picture pass.
#pragma once

#include <cstdint>

namespace render {

enum class TileClass : std::uint8_t {
    background,  ///< and nothing else
    ground,      ///< that nothing dims, and nothing else
    picture      ///< anything else
};

}  // namespace render
