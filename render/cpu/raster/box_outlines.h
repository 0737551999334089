// The share of a pixel that a face of a box shows where the face's outline crosses the pixel. Four samples tell it to a
// quarter only, and along a straight outline those of the nearly same height make steps that the eye follows. Called by
// picture_colors.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"

namespace render {

/// The share of a pixel that a face of a box covers as seen from the eye, 0 to 1. It is exact where one edge crosses
/// the pixel, and the product of the shares beside both edges where a corner lies in it.
/// @param face    0 +x, 1 -x, 2 +y, ... 5 -z
/// @param middle  of the pixel, pixels
float faceShare(const CameraFrame& frame, const BoxObstacle& box, int face, glm::vec2 middle);

/// What some of a pixel's four samples hit.
struct SampledHit {
    std::int32_t hitId = 0;  ///< see primary_hits.h
    int sampleCount = 0;
};

/// The share of a pixel that the first of two hits has, if one of them is a face of a box whose outline crosses the
/// pixel. Nothing if none is, and where the samples contradict it by more than their error of a quarter: something else
/// hides a part of the face.
std::optional<float> shareOfFirst(const CameraFrame& frame, std::span<const BoxObstacle> boxes,
                                  const std::array<SampledHit, 2>& hits, glm::vec2 middle);

}  // namespace render
