// Differences made visible, for reports.
#pragma once

#include "render/picture/image.h"

namespace render {

/// Absolute differences of the channels, sixteen times as bright. Shape: pictures of one size.
Image differenceImage(const Image& actual, const Image& expected);

/// The largest difference of a pixel's channels on a logarithmic scale of colors, dark blue for one step, white for
/// 255; where there is none, the expected picture in dark gray, so that one sees where one is. Shape: pictures of one
/// size.
Image heatMap(const Image& actual, const Image& expected);

}  // namespace render
