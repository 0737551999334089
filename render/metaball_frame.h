// The metaballs of one view, cast: samples of their surface for the picture, heights for the shadows. Called by the
// picture pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/camera_frame.h"
#include "render/field_sample.h"
#include "render/light_space.h"
#include "render/metaball_cast.h"
#include "render/skin.h"
#include "render/tiles.h"
#include "render/view.h"

namespace render {

struct FieldPicture {
    std::vector<FieldSample> samples;  ///< 256 a slot, row by row, then the extra samples
    std::vector<std::uint32_t> open;   ///< of each sample, as packBlock() has it; empty without
    std::vector<std::int32_t> slots;   ///< per tile; -1 where nothing of the surface is seen
};

/// Where in the pixel the rays go.
struct FieldSampling {
    glm::vec2 offset{0.0F};        ///< of the one sample, in pixels from the middle
    bool extraAtOutlines = false;  ///< four more samples where neighbours differ
    bool sparse = false;  ///< every second pixel of every second row is cast, others where the surface is not smooth
};

/// Heights of the surface over the light's plane.
struct DepthMap {
    glm::vec2 origin{0.0F};
    float texelSize = 1.0F;
    int columns = 1;
    int rows = 1;
    std::vector<float> heights;  ///< towards the light; kNoHeight where there is no surface
};

inline constexpr float kNoHeight = -3e38F;

/// The particles of a view as metaballs.
struct Skinned {
    const View& view;
    std::span<const SkinBall> balls;  ///< one a particle
    std::span<const Openness> open;   ///< likewise, or empty
};

/// Balls in a camera's coordinates; radii not above zero are left out.
std::vector<FieldBall> fieldBalls(const CameraFrame& frame, const Skinned& skin);

/// Half a radius of the smallest ball per step: metaball_test.cpp finds no hit missed against the oracle's exact roots.
/// Overwrites `picture`, whose memory is used again.
void castPicture(const CameraFrame& frame, const Skinned& skin, const FieldSampling& sampling, FieldPicture& picture);

struct DepthMapSampling {
    int mostTexels = 1024;  ///< along the longer side
    glm::vec2 shift{0.0F};  ///< of the texels, in texels, less than a half: pictures of several maps average them
};

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling);

}  // namespace render
