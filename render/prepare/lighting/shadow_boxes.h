// The boxes that cast shadows: those of a view, where neighbors are joined such that no seams show between them and
// nothing is counted twice. Section 4 of shading_model.h defines them. Called by the preparation of a view.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/picture/view.h"

namespace render {

/// Boxes whose coverages of the light are subtracted and added up. Their colors have no meaning.
struct ShadowBoxes {
    std::vector<BoxObstacle> boxes;   ///< in world coordinates; those whose coverage is subtracted come first
    std::size_t subtractedCount = 0;  ///< number of boxes whose coverage is subtracted
};

/// Largest number of boxes in a group that is joined, and of terms to each of them. Chosen: walls, floors and steps of
/// a scene are far below. They bound the time that hundreds of boxes take that stand in each other.
inline constexpr std::size_t kMostJoinedBoxes = 256;
inline constexpr std::size_t kMostTermsPerBox = 16;

/// Joins boxes that touch or overlap. A box that touches no other one is left as it is.
ShadowBoxes shadowBoxes(std::span<const BoxObstacle> boxes);

}  // namespace render
