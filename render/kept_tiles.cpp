// A look per tile, forgotten with the backdrop.
#include "render/kept_tiles.h"

namespace render {

void KeptTiles::begin(const Backdrop& backdrop, std::size_t tileCount) {
    if (backdrop == backdrop_ && looks_.size() == tileCount) return;
    backdrop_ = backdrop;
    looks_.assign(tileCount, TileClass::kept);
}

bool KeptTiles::keeps(std::size_t tile, TileClass look) {
    const bool kept = look != TileClass::picture && looks_[tile] == look;
    looks_[tile] = look;
    return kept;
}

}  // namespace render
