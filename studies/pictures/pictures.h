// What pictures cost and how exact they are, drawn on the CPU and with OpenGL: times of the renderers' stages and of
// whole frames, the error against the oracle, and flicker under a moving camera. On the CPU alone: times of encoding,
// and what the smoothing of metaball surfaces costs and changes. Called by `globular study pictures`, which writes the
// results.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/opengl/context/context.h"
#include "render/picture/draw_times.h"
#include "render/picture/image.h"
#include "render/picture/view.h"
#include "studies/oracle/oracle.h"

namespace studies {

/// The two renderers of render/renderer.h.
enum class RendererKind { cpu, opengl };

const char* nameOf(RendererKind renderer);
const char* nameOf(render::Style style);
const char* nameOf(render::Quality quality);
const char* nameOf(render::Skin smoothing);

/// How much a picture differs from the oracle's exact one, over all windows that were compared.
struct PictureError {
    double rmse = 0.0;       ///< root mean square error of the colors, in steps of an 8-bit channel
    double ssim = 0.0;       ///< structural similarity (SSIM), mean over the windows
    double wrongHits = 0.0;  ///< share of the pixels that show another surface than the exact picture
    double depth = 0.0;      ///< mean error of depth over the right hits on particles, mean radii
    double normal = 0.0;     ///< mean error of the normal over the right hits on particles, degrees
    std::size_t pixels = 0;  ///< number of pixels compared
};

/// A window of a picture, and the oracle's exact picture inside it.
struct ExactWindow {
    oracle::Window window;
    oracle::Picture picture;
};

/// Compares a picture of a view with windows of the exact picture. A pixel is a right hit if its depth is exact to a
/// tenth of the particles' mean radius.
/// @param surfaces  the visible point of every pixel
PictureError errorOf(const render::Image& image, std::span<const render::VisiblePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact);

inline constexpr render::Style kStyles[] = {render::Style::spheres, render::Style::metaballs};
inline constexpr render::Quality kQualities[] = {render::Quality::draft, render::Quality::normal,
                                                 render::Quality::final};
inline constexpr RendererKind kRendererKinds[] = {RendererKind::cpu, RendererKind::opengl};

/// Which picture of the dam break is measured, and what draws it.
struct PictureSubject {
    render::Style style = render::Style::spheres;
    std::size_t particles = 0;
    render::PictureSize size{0, 0};
    render::Quality quality = render::Quality::normal;
    RendererKind renderer = RendererKind::cpu;
};

/// Median times over some frames, s.
struct DrawingTimes {
    double draw = 0.0;              ///< time to draw a frame and read it back
    render::DrawTimes stages = {};  ///< times of the stages of the renderer
};

/// Times of encoding, s.
struct EncodingTimes {
    double png = 0.0;      ///< time to encode a frame as PNG
    double mp4 = 0.0;      ///< time to encode a frame of a video
    double mp4Once = 0.0;  ///< time that a video takes besides its frames
    double withPng = 0.0;  ///< time per frame if one is encoded as PNG while the next is drawn
    double withMp4 = 0.0;  ///< time per frame if one is encoded for a video while the next is drawn
};

/// What the study measures of one picture by one renderer.
struct PictureRow : PictureSubject {
    DrawingTimes moving = {};                    ///< times of drawing while the camera moves
    DrawingTimes atRest = {};                    ///< times of drawing while the particles move before a still camera
    std::optional<EncodingTimes> encoding = {};  ///< measured with the pictures of the CPU's renderer alone
    PictureError error = {};
    double timeRatio = 1.0;  ///< moving.draw over that of the same picture on the CPU
    double rmseRatio = 1.0;  ///< error.rmse over that of the same picture on the CPU
};

struct PictureSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};  ///< numbers of particles, at least one
    std::vector<render::PictureSize> sizes = {{1280, 720}, {1920, 1080}};
    int frames = 11;         ///< number of frames that medians are taken of
    int encodedFrames = 20;  ///< number of frames in measurements with encoding
    int windowColumns = 6;   ///< columns of the grid of windows in which the error is measured
    int windowRows = 4;      ///< rows of the grid of windows
    int windowSide = 32;     ///< width and height of a window, pixels
    int samplesPerAxis = 4;  ///< the exact picture has the square of this number of samples per pixel
    std::string videoPath;   ///< file of the video that encoding is timed with; overwritten
};

/// What the study measures of a look that is not that of the dam break.
struct LookRow : PictureSubject {
    std::string look;   ///< what it has in addition
    double draw = 0.0;  ///< median time to draw a frame and read it back, s
    PictureError error = {};
    double timeRatio = 1.0;  ///< draw over that of the dam break's own look by the same renderer
};

/// Called after each new row of a table, with all rows so far.
template <typename Row>
using RowsListener = std::function<void(const std::vector<Row>&)>;

/// Measures a picture of every style, size, number of particles and quality, by every renderer.
/// @param context  where OpenGL draws; null: the renderer on the CPU is measured alone
/// @throws render::SystemError
std::vector<PictureRow> measurePictures(const PictureSettings& settings, render::Context* context,
                                        const RowsListener<PictureRow>& listener);

/// Measures the dam break as metaballs in normal quality with each of some more looks, after its own, by every
/// renderer, and in final quality without and with blur. Particles and size are the first of the settings.
/// @param context  as for measurePictures()
/// @throws render::SystemError
std::vector<LookRow> measureLooks(const PictureSettings& settings, render::Context* context,
                                  const RowsListener<LookRow>& listener);

/// How steady pictures of a still scene are while the camera moves slowly. I_k is picture k, in 8-bit steps.
struct FlickerRow : PictureSubject {
    double change = 0.0;  ///< mean RMS of I_(k+1) - I_k over the frames; contains the motion
    double jerk = 0.0;    ///< mean RMS of I_(k+1) - 2 I_k + I_(k-1) over the frames; small where pixels change steadily
};

struct FlickerSettings {
    std::size_t particles = 10000;
    render::PictureSize size{640, 360};
    int frames = 8;                 ///< number of successive pictures, at least 3
    double pixelsPerFrame = 0.125;  ///< motion of the center of the picture, pixels per frame
};

/// Measures the flicker of pictures of every style and quality, by every renderer.
/// @param context  as for measurePictures()
/// @throws render::SystemError
std::vector<FlickerRow> measureFlicker(const FlickerSettings& settings, render::Context* context,
                                       const RowsListener<FlickerRow>& listener);

/// Quality and cost of the metaball surface with or without smoothing, on the CPU.
struct SmoothingRow {
    render::Skin skin = render::Skin::plain;
    std::size_t particles = 0;
    double draw = 0.0;    ///< median time to draw a frame of normal quality and read it back, s
    double volume = 0.0;  ///< volume inside the surface of a level pool, over that of the pool; 1 is right
    double lone = 0.0;    ///< volume inside the surface of a single particle, over that of its sphere
    double bumps = 0.0;   ///< RMS tilt of the normals on the level pool, degrees
};

struct SmoothingSettings {
    std::vector<std::size_t> particles = {2000, 10000, 50000, 200000};
    render::PictureSize size{1280, 720};
    int frames = 7;         ///< number of frames that medians are taken of
    double spacing = 0.25;  ///< spacing of the points that volumes are sampled at, mean radii
};

/// Measures the metaball surface without and with smoothing, for each number of particles.
/// @throws render::SystemError
std::vector<SmoothingRow> measureSmoothing(const SmoothingSettings& settings,
                                           const RowsListener<SmoothingRow>& listener);

/// Volume inside the metaball surface of a view with at least one particle, m^3: the number of points of a cubic
/// lattice inside the surface, times the volume of a lattice cell.
/// @param spacing  spacing of the lattice, mean radii
double fieldVolume(const render::View& view, double spacing);

/// The tables of the study as CSV with a header line.
std::string picturesCsv(const std::vector<PictureRow>& rows);
std::string looksCsv(const std::vector<LookRow>& rows);
std::string flickerCsv(const std::vector<FlickerRow>& rows);
std::string smoothingCsv(const std::vector<SmoothingRow>& rows);

/// gnuplot scripts: milliseconds per frame against the number of particles, and 1 - SSIM against milliseconds.
std::string pictureTimesPlot(const std::vector<PictureRow>& rows, const std::vector<SmoothingRow>& smoothing);
std::string pictureErrorsPlot(const std::vector<PictureRow>& rows);

}  // namespace studies
