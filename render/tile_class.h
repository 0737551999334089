// Classes of tiles: those that are drawn alike are drawn together. Used by the picture pass.
#pragma once

#include <cstdint>

namespace render {

enum class TileClass : std::uint8_t {
    kept,        ///< is not drawn, because the target holds it already
    background,  ///< and nothing else
    ground,      ///< that nothing dims, and nothing else
    picture      ///< anything else: pixel by pixel
};

inline constexpr int kTileClasses = 4;

}  // namespace render
