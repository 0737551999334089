// What pictures cost and how exact they are: times of the renderer's stages and of whole frames with their encoding,
// the error against the oracle, flicker under a moving camera, and what the smoothing of metaball surfaces costs and
// changes. Called by `globular study pictures`, which writes the results.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/cpu/draw_times.h"
#include "render/opengl/context.h"
#include "render/picture/image.h"
#include "render/picture/view.h"
#include "render/renderer.h"
#include "studies/oracle/oracle.h"

namespace studies {

const char* nameOf(render::Style style);
const char* nameOf(render::Quality quality);
const char* nameOf(render::Skin smoothing);

/// Distance of a picture from the exact one, over all windows.
struct PictureError {
    double rmse = 0.0;       ///< steps of an 8-bit channel
    double ssim = 0.0;       ///< mean over the windows of the structural similarity, see render::measure()
    double wrongHits = 0.0;  ///< share of the pixels whose center shows another surface than in the exact picture
    double depth = 0.0;      ///< mean over the right hits on particles, mean radii
    double normal = 0.0;     ///< mean over the right hits on particles, degrees
    std::size_t pixels = 0;  ///< number of pixels compared
};

/// A window of the exact picture.
struct ExactWindow {
    oracle::Window window;
    oracle::Picture picture;
};

/// Compares a picture of a view, and the surfaces that it shows, with the exact windows. A hit is right if its depth is
/// exact to a tenth of the particles' mean radius.
PictureError errorOf(const render::Image& image, std::span<const render::VisiblePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact);

inline constexpr render::Style kStyles[] = {render::Style::spheres, render::Style::metaballs};
inline constexpr render::Quality kQualities[] = {render::Quality::draft, render::Quality::normal,
                                                 render::Quality::final};

/// A picture of the dam break that is measured.
struct PictureSubject {
    render::Style style = render::Style::spheres;
    std::size_t particles = 0;
    render::PictureSize size{0, 0};
    render::Quality quality = render::Quality::normal;
};

/// The measurements of one picture. All times are in seconds.
struct PictureRow : PictureSubject {
    render::DrawTimes stages = {};  ///< medians over the frames
    double png = 0.0;               ///< encoding a frame as PNG
    double mp4 = 0.0;               ///< encoding a frame of a video
    double mp4Once = 0.0;           ///< what a video takes besides its frames
    double draw = 0.0;              ///< drawing a frame and reading it back, the camera moving; median
    double atRest = 0.0;            ///< drawing a frame and reading it back, the particles moving before a still camera
    double atRestBaseline = 0.0;    ///< the baseline for the frames of atRest
    double withPng = 0.0;           ///< per frame, if one is encoded while the next is drawn
    double withMp4 = 0.0;           ///< per frame, if one is encoded while the next is drawn
    double baseline = 0.0;          ///< QuadBaseline for the frames of draw, drawn by turns with them; median
    double fewestBaseline = 0.0;    ///< QuadBaseline for the smallest number of particles in the study
    PictureError error = {};

    double ratio() const { return draw / baseline; }
    double ratioToFewest() const { return draw / fewestBaseline; }
    double ratioAtRest() const { return atRest / atRestBaseline; }
};

struct PictureSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};  ///< at least one number
    std::vector<render::PictureSize> sizes = {{1280, 720}, {1920, 1080}};
    int frames = 11;         ///< that medians are taken of
    int encodedFrames = 20;  ///< of the runs with encoding
    int windowColumns = 6;   ///< the windows in which the error is measured form a grid over the picture
    int windowRows = 4;
    int windowSide = 32;     ///< pixels
    int samplesPerAxis = 4;  ///< of a pixel of the exact picture
    std::string videoPath;   ///< of the video that encoding is timed with; overwritten
};

/// Called with all rows so far after each new row.
template <typename Row>
using RowsListener = std::function<void(const std::vector<Row>&)>;

/// Measures every style, size, number of particles and quality.
/// @throws render::SystemError
std::vector<PictureRow> measurePictures(const PictureSettings& settings, const RowsListener<PictureRow>& listener);

/// How steady pictures of a still scene are while the camera moves slowly. With I_k the picture of frame k, in steps of
/// an 8-bit channel:
struct FlickerRow : PictureSubject {
    double change = 0.0;  ///< mean over the frames of the RMS of I_(k+1) - I_k, which contains the motion
    double jerk = 0.0;    ///< mean over the frames of the RMS of I_(k+1) - 2 I_k + I_(k-1), which is small for a motion
};

struct FlickerSettings {
    std::size_t particles = 10000;
    render::PictureSize size{640, 360};
    int frames = 8;                 ///< at least 3
    double pixelsPerFrame = 0.125;  ///< motion of the center of the picture
};

/// Measures every style and quality.
/// @throws render::SystemError
std::vector<FlickerRow> measureFlicker(const FlickerSettings& settings, const RowsListener<FlickerRow>& listener);

/// What a metaball surface is like with or without smoothing (render::Skin).
struct SmoothingRow {
    render::Skin skin = render::Skin::plain;
    std::size_t particles = 0;
    double draw = 0.0;    ///< median time to draw a frame of normal quality and read it back, s
    double volume = 0.0;  ///< inside the surface of a level pool, over its particles' share of space: 1 is right
    double lone = 0.0;    ///< inside the surface of a single particle, over the volume of its sphere
    double bumps = 0.0;   ///< RMS tilt of the normals of the level pool's surface, degrees
};

struct SmoothingSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};
    render::PictureSize size{1280, 720};
    int frames = 7;         ///< that medians are taken of
    double spacing = 0.25;  ///< of the points that volumes are sampled at, mean radii
};

/// Measures surfaces without and with smoothing, for each number of particles.
/// @throws render::SystemError
std::vector<SmoothingRow> measureSmoothing(const SmoothingSettings& settings,
                                           const RowsListener<SmoothingRow>& listener);

/// Volume inside the metaball surface of a view with at least one particle, m^3: the number of points of a cubic
/// lattice inside the surface, times the volume of a lattice cell.
/// @param spacing  of the lattice, mean radii
double fieldVolume(const render::View& view, double spacing);

/// CSV with a header line.
std::string picturesCsv(const std::vector<PictureRow>& rows);
std::string flickerCsv(const std::vector<FlickerRow>& rows);
std::string smoothingCsv(const std::vector<SmoothingRow>& rows);

/// gnuplot scripts: milliseconds per frame against particles, and 1 - SSIM against milliseconds.
std::string pictureTimesPlot(const std::vector<PictureRow>& rows, const std::vector<SmoothingRow>& smoothing);
std::string pictureErrorsPlot(const std::vector<PictureRow>& rows);

}  // namespace studies
