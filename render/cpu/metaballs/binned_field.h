// The metaballs of one view as a camera or the light sees them: in its coordinates, listed for each tile that they
// reach. Used by all that casts them.
#pragma once

#include <span>
#include <vector>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/skin.h"
#include "render/prepare/tiles.h"

namespace render {

/// The particles of a view as metaballs.
struct Skinned {
    const View& view;
    std::span<const SkinBall> balls;      ///< one a particle
    std::span<const SkyVisibility> open;  ///< likewise, or empty
};

struct BinnedField {
    std::vector<FieldBall> balls;
    std::vector<std::size_t> particles;  ///< which each ball is
    CellLists tiles;                     ///< of the balls' reaches, front to back
    float smallestRadius = 1.0F;         ///< of the particles, or a tenth of the mean where that is more
};

/// Radii not above zero are left out.
BinnedField binField(const CameraFrame& frame, const Skinned& skin);

/// Of each of the field's balls.
std::vector<BallLook> ballLooks(const Skinned& skin, const BinnedField& field);

/// Half a radius of the smallest ball per step: metaball_test.cpp finds no hit missed against the oracle's exact roots.
/// The field must outlive it. Without looks.
FieldCast fieldCast(const CameraFrame& frame, const View& view, const BinnedField& field);

}  // namespace render
