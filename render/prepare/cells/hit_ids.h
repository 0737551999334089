// What rays hit, as one number. Used by everything that traces rays.
#pragma once

#include <cstdint>

namespace render {

// A hit id tells what a ray hits, as one number. Hit ids from 0 up to kHitTriangle are indices of spheres.
inline constexpr std::int32_t kHitBackground = -1;
inline constexpr std::int32_t kHitGround = -2;
/// The hit id of a mesh obstacle is kHitTriangle + the index of a triangle.
inline constexpr std::int32_t kHitTriangle = 1 << 27;
/// The hit id of a box is kHitBox + 16 * its index + the face that is hit (0 +x, 1 -x, 2 +y, ... 5 -z) + 8 if the eye
/// is inside.
inline constexpr std::int32_t kHitBox = 1 << 28;
/// The hit id of metaballs is kHitMetaballs + an index in MetaballHits::hits.
inline constexpr std::int32_t kHitMetaballs = 1 << 29;

}  // namespace render
