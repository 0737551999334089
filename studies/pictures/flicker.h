// Whether pictures are steady: a still scene under a camera that moves slowly. Used by the study of pictures.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "render/opengl/context.h"
#include "render/picture/view.h"

namespace studies {

/// In 8-bit steps. With I_k the pictures of successive frames:
struct FlickerRow {
    render::Style style = render::Style::spheres;
    std::size_t particles = 0;
    render::PictureSize size{0, 0};
    render::Quality quality = render::Quality::normal;
    double change = 0.0;  ///< RMSE of I_(k+1) - I_k, mean over the frames: what moves
    double jerk = 0.0;    ///< RMSE of I_(k+1) - 2 I_k + I_(k-1), likewise: what does not move smoothly
};

struct FlickerSettings {
    std::size_t particles = 10000;
    render::PictureSize size{640, 360};
    int frames = 8;                 ///< at least 3
    double pixelsPerFrame = 0.125;  ///< that the middle of the picture moves
    render::Backend backend = render::Backend::osmesa;
};

/// Told of all rows so far, after each.
using FlickerListener = std::function<void(const std::vector<FlickerRow>&)>;

/// Every style and quality. Throws render::SystemError.
std::vector<FlickerRow> measureFlicker(const FlickerSettings& settings, const FlickerListener& listener);

std::string flickerCsv(const std::vector<FlickerRow>& rows);

}  // namespace studies
