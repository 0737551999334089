// The main table of the study of pictures: times drawing a dam break and encoding it as PNG and video, and compares
// windows of the picture with the oracle's. See pictures.h.
#include "studies/pictures/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "render/output/png.h"
#include "render/output/video.h"
#include "render/renderer.h"
#include "studies/common/timing.h"
#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/quad_baseline.h"

namespace studies {
namespace {

using render::DrawTimes;

/// A view in several frames, between which the particles move to the right and the camera is at rest.
std::vector<render::View> framesAtRest(const render::View& view, int count) {
    std::vector<render::View> frames;
    for (int frame = 0; frame < count; ++frame) {
        frames.push_back(view);
        for (render::Sphere& particle : frames.back().particles) particle.center.x += 0.02F * static_cast<float>(frame);
    }
    return frames;
}

DrawTimes medianStages(const std::vector<DrawTimes>& times) {
    const auto medianOf = [&times](double DrawTimes::*stage) {
        std::vector<double> values;
        for (const DrawTimes& time : times) values.push_back(time.*stage);
        return median(values);
    };
    return {medianOf(&DrawTimes::bin),     medianOf(&DrawTimes::occlusion), medianOf(&DrawTimes::shadow),
            medianOf(&DrawTimes::cast),    medianOf(&DrawTimes::color),     medianOf(&DrawTimes::upload),
            medianOf(&DrawTimes::readBack)};
}

/// Wall-clock time of drawing `count` frames, each while the one before is encoded, as in the rendering of a scene, s.
double overlapped(render::Renderer& renderer, const std::vector<render::View>& frames, int count,
                  const std::function<void(const render::Image&)>& encode) {
    constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
    std::array<render::Image, 3> buffers;  // images of the frames in the pipeline
    int next = 0;
    const auto drawNext = [&](tbb::flow_control& flow) -> render::Image* {
        if (next == count) {
            flow.stop();
            return nullptr;
        }
        const auto frame = static_cast<std::size_t>(next++);
        render::Image& image = buffers[frame % buffers.size()];
        tbb::this_task_arena::isolate([&] { image = renderer.draw(frames[frame % frames.size()], std::move(image)); });
        return &image;
    };
    return secondsOf([&] {
        tbb::parallel_pipeline(buffers.size(), tbb::make_filter<void, render::Image*>(kInOrder, drawNext) &
                                                   tbb::make_filter<render::Image*, void>(
                                                       kInOrder, [&](render::Image* image) { encode(*image); }));
    });
}

/// Wall-clock time of encoding a video of `count` frames, s. The images are used in turn.
double secondsOfVideo(const render::VideoOptions& options, const std::vector<render::Image>& images, int count) {
    render::VideoWriter video(options);
    return secondsOf([&] {
        for (int k = 0; k < count; ++k) video.add(images[static_cast<std::size_t>(k) % images.size()]);
        video.finish();
    });
}

/// Measures the times of PNG and video encoding, alone and together with drawing. What a video costs besides its frames
/// is the time of a video of one frame minus the time per frame, which is measured with a video of many more frames.
void measureEncoding(const PictureSettings& settings, const std::vector<render::View>& frames,
                     render::Renderer& renderer, PictureRow& row) {
    // Drawing the frames takes at most about a second and a half. Chosen: slow frames take about the same time each.
    const int count = std::min(settings.encodedFrames, std::max(3, static_cast<int>(1.5 / row.moving.draw)));
    const render::Image image = renderer.draw(frames.front());
    row.png = secondsOf([&] { render::encodePng(image); }, 3);
    row.withPng = overlapped(renderer, frames, count, [](const render::Image& i) { render::encodePng(i); }) / count;
    std::vector<render::Image> images;
    for (int k = 0; k < count; ++k)
        images.push_back(renderer.draw(frames[static_cast<std::size_t>(k) % frames.size()]));
    render::VideoOptions options;
    options.path = settings.videoPath;
    options.size = row.size;
    const double one = secondsOfVideo(options, images, 1);
    row.mp4 = std::max(0.0, secondsOfVideo(options, images, 1 + settings.encodedFrames) - one) / settings.encodedFrames;
    row.mp4Once = std::max(0.0, one - row.mp4);
    render::VideoWriter video(options);
    double seconds = overlapped(renderer, frames, count, [&](const render::Image& i) { video.add(i); });
    seconds += secondsOf([&] { video.finish(); });
    row.withMp4 = std::max(0.0, seconds - row.mp4Once) / count;
}

/// The exact picture of a view, in windows that are spread evenly over the picture.
std::vector<ExactWindow> exactWindows(const PictureSettings& settings, const render::View& view,
                                      render::PictureSize size) {
    std::vector<ExactWindow> windows;
    for (int row = 0; row < settings.windowRows; ++row)
        for (int column = 0; column < settings.windowColumns; ++column)
            windows.push_back({{(2 * column + 1) * size.width / (2 * settings.windowColumns) - settings.windowSide / 2,
                                (2 * row + 1) * size.height / (2 * settings.windowRows) - settings.windowSide / 2,
                                settings.windowSide, settings.windowSide},
                               {}});
    const oracle::Scene scene(view);
    tbb::parallel_for(std::size_t{0}, windows.size(), [&](std::size_t k) {
        windows[k].picture = oracle::drawWindow(scene, size, windows[k].window, settings.samplesPerAxis);
    });
    return windows;
}

/// Times drawing with the baseline and with the renderer. They draw every frame by turns, so that changes of the
/// machine's speed affect both alike.
/// @param fewest  another view for the baseline to draw by turns with the frames; null: none
DrawingTimes measureDrawing(QuadBaseline& quads, render::Renderer& renderer, const std::vector<render::View>& frames,
                            const render::View* fewest = nullptr) {
    std::vector<DrawTimes> times;
    std::vector<double> baseline, fewestBaseline, draw;
    // Drawing a first frame compiles shaders and allocates memory.
    render::Image quadImage = quads.draw(frames.front());
    render::Image ours = renderer.draw(frames.front());
    for (const render::View& view : frames) {
        if (fewest != nullptr)
            fewestBaseline.push_back(secondsOf([&] { quadImage = quads.draw(*fewest, std::move(quadImage)); }));
        baseline.push_back(secondsOf([&] { quadImage = quads.draw(view, std::move(quadImage)); }));
        draw.push_back(secondsOf([&] { ours = renderer.draw(view, std::move(ours)); }));
        times.push_back(renderer.times());
    }
    return {median(draw), medianStages(times), median(baseline), fewest == nullptr ? 0.0 : median(fewestBaseline)};
}

/// The views that are drawn to measure the times of pictures of one style and one number of particles.
struct TimedViews {
    std::vector<render::View> frames;  ///< the view in frames between which the camera moves
    const render::View& fewest;        ///< the view with the smallest number of particles in the study
};

/// Measures all times of a picture. The row says which picture, and receives the times.
void measureTimes(const PictureSettings& settings, render::Context& context, const TimedViews& views, PictureRow& row) {
    render::Renderer renderer(row.size, row.quality);
    {
        QuadBaseline quads(context, row.size);
        row.moving = measureDrawing(quads, renderer, views.frames, &views.fewest);
        row.atRest = measureDrawing(quads, renderer, framesAtRest(views.frames.front(), settings.frames));
    }
    measureEncoding(settings, views.frames, renderer, row);
}

}  // namespace

std::vector<PictureRow> measurePictures(const PictureSettings& settings, const RowsListener<PictureRow>& listener) {
    render::Context context(render::Device{render::Backend::osmesa});
    std::vector<PictureRow> rows;
    for (const render::Style style : kStyles) {
        const render::View fewest = damBreakView(std::ranges::min(settings.particles), style);
        for (const render::PictureSize size : settings.sizes)
            for (const std::size_t particles : settings.particles) {
                const render::View view = damBreakView(particles, style);
                const TimedViews views{framesOf(view, settings.frames), fewest};
                const std::vector<ExactWindow> exact = exactWindows(settings, view, size);
                for (const render::Quality quality : kQualities) {
                    PictureRow row{{style, particles, size, quality}};
                    measureTimes(settings, context, views, row);
                    render::Renderer renderer(size, quality);
                    row.error = errorOf(renderer.draw(view), renderer.visiblePoints(view), view, exact);
                    rows.push_back(row);
                    listener(rows);
                }
            }
    }
    return rows;
}

}  // namespace studies
