// What a smooth skin of metaballs costs and brings beside the plain one. Used by the study of pictures.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "render/opengl/context.h"
#include "render/picture/view.h"

namespace studies {

struct SmoothingRow {
    render::Skin skin = render::Skin::plain;
    std::size_t particles = 0;
    double draw = 0.0;  ///< one frame of normal quality, drawn and read back, s; median
    double volume =
        0.0;  ///< within the surface of a level pool, over the cells of its particles: 1 neither swells nor shrinks
    double lone = 0.0;   ///< within that of one particle alone, over its sphere
    double bumps = 0.0;  ///< tilt of the normal of a level pool's surface, degrees; RMS
};

struct SmoothingSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};
    render::PictureSize size{1280, 720};
    int frames = 7;         ///< to take medians of
    double spacing = 0.25;  ///< of the samples of the volume, mean radii
    render::Backend backend = render::Backend::osmesa;
};

const char* nameOf(render::Skin skin);

/// Told of all rows so far, after each.
using SmoothingListener = std::function<void(const std::vector<SmoothingRow>&)>;

/// Plain and smooth for each number of particles. Throws render::SystemError.
std::vector<SmoothingRow> measureSmoothing(const SmoothingSettings& settings, const SmoothingListener& listener);

/// Volume within the surface of a view's metaballs (at least one), m^3: cubes with sides of so many mean radii, whose
/// middles are inside.
double fieldVolume(const render::View& view, double spacing);

std::string smoothingCsv(const std::vector<SmoothingRow>& rows);

}  // namespace studies
