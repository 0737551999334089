// Finds the tiles of the picture that show nothing but background or ground, which are most tiles of many pictures.
// They are colored without a search for what their rays hit, and without shadows where none can fall. Called by the
// preparation of a view.
#pragma once

#include <vector>

#include "render/prepare/prepared_view.h"

namespace render {

/// Classifies the tiles of a view with ground, row by row, by what they show as long as nothing stands before the
/// ground.
/// @param view  prepared but for this
std::vector<TileKind> groundTiles(const PreparedView& view);

}  // namespace render
