// How far a picture is from the exact one, in windows of it. Used by the study of pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/image.h"
#include "render/renderer.h"
#include "studies/oracle.h"

namespace studies {

struct PictureError {
    double rmse = 0.0;       ///< steps of an 8-bit channel
    double ssim = 0.0;       ///< of the luma: mean over all places of an 11 x 11 Gaussian window
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

/// Structural similarity of two grey pictures of the same size, values 0 to 255 (Wang et al. 2004: 11 x 11 Gaussian of
/// sigma 1.5, constants 0.01 and 0.03), the mean over the windows that lie inside. Shape: at least 11 x 11.
double structuralSimilarity(std::span<const double> a, std::span<const double> b, int width, int height);

/// The errors of a picture of a view, and of the surfaces that it shows, in the windows.
/// A hit is right within a tenth of the particles' mean radius.
PictureError errorOf(const render::Image& image, std::span<const render::SurfacePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact);

}  // namespace studies
