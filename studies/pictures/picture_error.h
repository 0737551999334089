// How far a picture is from the exact one, in windows of it. Used by the study of pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/image.h"
#include "render/renderer.h"
#include "studies/oracle/oracle.h"

namespace studies {

struct PictureError {
    double rmse = 0.0;       ///< steps of an 8-bit channel
    double ssim = 0.0;       ///< see render::structuralSimilarity; the mean over the windows
    double wrongHits = 0.0;  ///< share of the pixels' middles that show another surface, or none, or one for none
    double depth = 0.0;      ///< mean over the right hits on particles, radii
    double normal = 0.0;     ///< likewise, degrees
    std::size_t pixels = 0;  ///< compared
};

/// A window of the exact picture.
struct ExactWindow {
    oracle::Window window;
    oracle::Picture picture;
};

/// The errors of a picture of a view, and of the surfaces that it shows, in the windows.
/// A hit is right within a tenth of the particles' mean radius.
PictureError errorOf(const render::Image& image, std::span<const render::VisiblePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact);

}  // namespace studies
