// What pictures cost and how exact they are: milliseconds of each stage, of whole frames with their encoding, the error
// against the oracle, and the ratio to the baseline drawn in the same run. Called by `globular study pictures`.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "render/cpu/draw_times.h"
#include "render/opengl/context.h"
#include "render/picture/view.h"
#include "studies/pictures/picture_error.h"
#include "studies/pictures/surface_smoothing.h"

namespace studies {

/// One style, number of particles, size and quality.
struct PictureRow {
    render::Style style = render::Style::spheres;
    std::size_t particles = 0;
    render::PictureSize size;
    render::Quality quality = render::Quality::normal;
    render::DrawTimes stages;     ///< medians over the frames, s
    double png = 0.0;             ///< of encoding alone, s
    double mp4 = 0.0;             ///< likewise
    double mp4Once = 0.0;         ///< of a video besides its frames
    double draw = 0.0;            ///< one frame, drawn and read back, s; median
    double atRest = 0.0;          ///< likewise where the camera rests and the particles move, s
    double atRestBaseline = 0.0;  ///< the quads of those frames, in turn with them, s
    double withPng = 0.0;         ///< a frame of many, one encoded while the next is drawn, s
    double withMp4 = 0.0;         ///< likewise
    double baseline = 0.0;  ///< the lit quads of the same spheres and size, drawn and read back in turn, s; median
    double fewestBaseline = 0.0;  ///< likewise of the fewest spheres that the study draws
    PictureError error;

    double ratio() const { return draw / baseline; }
    double ratioToFewest() const { return draw / fewestBaseline; }
    double ratioAtRest() const { return atRest / atRestBaseline; }
};

struct PictureSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};
    std::vector<render::PictureSize> sizes = {{1280, 720}, {1920, 1080}};
    int frames = 11;         ///< to take medians of
    int encodedFrames = 20;  ///< of the runs with encoding
    int windowColumns = 6;   ///< of windows over the picture, in which the error is taken
    int windowRows = 4;
    int windowSide = 32;     ///< pixels
    int samplesPerAxis = 4;  ///< of the exact picture
    std::string videoPath;   ///< a file to encode to, overwritten
    render::Backend backend = render::Backend::osmesa;
};

const char* nameOf(render::Style style);
const char* nameOf(render::Quality quality);

/// Told of all rows so far, after each.
using PictureListener = std::function<void(const std::vector<PictureRow>&)>;

/// Measures every style, number, size and quality. Throws render::SystemError.
std::vector<PictureRow> measurePictures(const PictureSettings& settings, const PictureListener& listener);

std::string picturesCsv(const std::vector<PictureRow>& rows);

/// gnuplot scripts: milliseconds a frame against particles, and error against milliseconds.
std::string pictureTimesPlot(const std::vector<PictureRow>& rows, const std::vector<SmoothingRow>& skins);
std::string pictureErrorsPlot(const std::vector<PictureRow>& rows);

}  // namespace studies
