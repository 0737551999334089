// The main table of the study of pictures: times drawing a dam break with each renderer and encoding it as PNG and
// video, and compares windows of the pictures with the oracle's. See pictures.h.
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
#include "render/picture/pixel_samples.h"
#include "studies/common/timing.h"
#include "studies/oracle/blur.h"
#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/renderers.h"

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
    return {medianOf(&DrawTimes::bin),    medianOf(&DrawTimes::occlusion), medianOf(&DrawTimes::shadow),
            medianOf(&DrawTimes::rays),   medianOf(&DrawTimes::cast),      medianOf(&DrawTimes::color),
            medianOf(&DrawTimes::upload), medianOf(&DrawTimes::readBack)};
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
/// @param secondsAFrame  about how long a frame takes to draw
EncodingTimes measureEncoding(const PictureSettings& settings, const std::vector<render::View>& frames,
                              render::Renderer& renderer, double secondsAFrame) {
    // Drawing the frames takes at most about a second and a half. Chosen: slow frames take about the same time each.
    const int count = std::min(settings.encodedFrames, std::max(3, static_cast<int>(1.5 / secondsAFrame)));
    const render::Image image = renderer.draw(frames.front());
    EncodingTimes times;
    times.png = secondsOf([&] { render::encodePng(image); }, 3);
    times.withPng = overlapped(renderer, frames, count, [](const render::Image& i) { render::encodePng(i); }) / count;
    std::vector<render::Image> images;
    for (int k = 0; k < count; ++k)
        images.push_back(renderer.draw(frames[static_cast<std::size_t>(k) % frames.size()]));
    render::VideoOptions options;
    options.path = settings.videoPath;
    options.size = {image.width, image.height};
    const double one = secondsOfVideo(options, images, 1);
    const double many = secondsOfVideo(options, images, 1 + settings.encodedFrames);
    times.mp4 = std::max(0.0, many - one) / settings.encodedFrames;
    times.mp4Once = std::max(0.0, one - times.mp4);
    render::VideoWriter video(options);
    double seconds = overlapped(renderer, frames, count, [&](const render::Image& i) { video.add(i); });
    seconds += secondsOf([&] { video.finish(); });
    times.withMp4 = std::max(0.0, seconds - times.mp4Once) / count;
    return times;
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
    if (render::hasBlur(view)) {
        const oracle::BlurredScene scene(view);
        // The moments are many samples already.
        const int perAxis = view.shutter ? (settings.samplesPerAxis + 1) / 2 : 2 * settings.samplesPerAxis;
        tbb::parallel_for(std::size_t{0}, windows.size(), [&](std::size_t k) {
            windows[k].picture = oracle::drawBlurred(scene, size, windows[k].window, perAxis);
        });
        return windows;
    }
    const oracle::Scene scene(view);
    tbb::parallel_for(std::size_t{0}, windows.size(), [&](std::size_t k) {
        windows[k].picture = oracle::drawWindow(scene, size, windows[k].window, settings.samplesPerAxis);
    });
    return windows;
}

/// Times drawing with each of the renderers. They draw every frame by turns, so that changes of the machine's speed
/// affect all alike.
std::vector<DrawingTimes> measureDrawing(const std::vector<ComparedRenderer>& renderers,
                                         const std::vector<render::View>& frames) {
    struct Samples {
        std::vector<double> draw;
        std::vector<DrawTimes> stages;
        render::Image image;
    };
    std::vector<Samples> samples(renderers.size());
    // Drawing a first frame compiles shaders and allocates memory.
    for (std::size_t k = 0; k < renderers.size(); ++k) samples[k].image = renderers[k].renderer->draw(frames.front());
    for (const render::View& view : frames)
        for (std::size_t k = 0; k < renderers.size(); ++k) {
            render::Image& image = samples[k].image;
            const auto draw = [&] { image = renderers[k].renderer->draw(view, std::move(image)); };
            samples[k].draw.push_back(secondsOf(draw));
            samples[k].stages.push_back(renderers[k].renderer->times());
        }
    std::vector<DrawingTimes> times;
    for (const Samples& each : samples) times.push_back({median(each.draw), medianStages(each.stages)});
    return times;
}

/// A view in frames between which the camera moves, and the exact picture of the first.
struct DrawnView {
    std::vector<render::View> frames;
    std::vector<ExactWindow> exact;
};

/// Measures a picture by every renderer, that on the CPU first.
/// @param subject  the picture; its renderer is ignored
std::vector<PictureRow> measurePicture(const PictureSettings& settings, render::Context* context,
                                       const PictureSubject& subject, const DrawnView& drawn) {
    const std::vector<ComparedRenderer> renderers = makeRenderers(context, subject.size, subject.quality);
    const render::View& view = drawn.frames.front();
    const std::vector<DrawingTimes> moving = measureDrawing(renderers, drawn.frames);
    const std::vector<DrawingTimes> atRest = measureDrawing(renderers, framesAtRest(view, settings.frames));
    std::vector<PictureRow> rows;
    for (std::size_t k = 0; k < renderers.size(); ++k) {
        render::Renderer& renderer = *renderers[k].renderer;
        PictureRow& row = rows.emplace_back(PictureRow{subject, moving[k], atRest[k]});
        row.renderer = renderers[k].kind;
        row.error = errorOf(renderer.draw(view), renderer.visiblePoints(view), view, drawn.exact);
        row.timeRatio = row.moving.draw / rows.front().moving.draw;
        row.rmseRatio = row.error.rmse / rows.front().error.rmse;
        if (row.renderer == RendererKind::cpu)
            row.encoding = measureEncoding(settings, drawn.frames, renderer, row.moving.draw);
    }
    return rows;
}

/// Opens the shutter for so long that particles that fly as fast as any move by three radii, around the middle of the
/// tank.
void openShutter(render::View& view) {
    const float radius = view.particles.front().radius;
    view.shutter.emplace();
    for (const render::Sphere& particle : view.particles) {
        const glm::vec3 off = particle.center - view.camera.target;
        view.shutter->velocities.push_back(3.0F * radius * glm::vec3(-off.y, off.x, 0.0F) / (1.0F + length(off)));
    }
    for (int k = 0; k < view.samplesPerAxis * view.samplesPerAxis; ++k)
        view.shutter->moments.push_back({static_cast<float>(render::sampleTime(k, view.samplesPerAxis)), view.camera,
                                         view.sphereObstacles, view.boxObstacles, view.meshObstacles, view.edges});
}

/// Opens the lens so wide that what is twice as far away as the target is blurred by a hundredth of the picture's
/// height.
void openLens(render::View& view) {
    const float height = 2.0F * std::tan(0.5F * view.camera.verticalFov);
    view.camera.aperture = 0.02F * height * distance(view.camera.eye, view.camera.target);
}

/// A look that the table of looks has.
struct NamedLook {
    const char* name = "";
    void (*add)(render::View&) = nullptr;  ///< changes the look of the dam break
    render::Quality quality = render::Quality::normal;
};

constexpr NamedLook kLooks[] = {
    {"as it is", [](render::View&) {}},
    {"anisotropic skin", [](render::View& view) { view.field.skin = render::Skin::anisotropic; }},
    {"glow", [](render::View& view) { view.surface.glow = 0.5F; }},
    {"rim light", [](render::View& view) { view.light.rim = glm::vec3(0.6F); }},
    {"transparent",
     [](render::View& view) {
         view.surface.translucency = 0.0F;
         view.surface.absorption = 0.0F;
         view.surface.medium = {0.9F, 1.33F, 2.0F};
     }},
    {"final quality", [](render::View&) {}, render::Quality::final},
    {"open shutter", openShutter, render::Quality::final},
    {"wide lens", openLens, render::Quality::final}};

/// The exact picture of a view with a look. It has more moments of an open shutter than the view has samples, so that
/// the error includes that of too few of them.
std::vector<ExactWindow> exactWindowsOf(const NamedLook& look, const PictureSettings& settings, render::View view,
                                        render::PictureSize size) {
    if (look.quality == render::Quality::final) view.samplesPerAxis = settings.samplesPerAxis + 1;
    look.add(view);
    return exactWindows(settings, view, size);
}

}  // namespace

std::vector<LookRow> measureLooks(const PictureSettings& settings, render::Context* context,
                                  const RowsListener<LookRow>& listener) {
    PictureSubject subject{render::Style::metaballs, settings.particles.front(), settings.sizes.front()};
    std::vector<LookRow> rows;
    std::vector<ComparedRenderer> renderers = makeRenderers(context, subject.size, subject.quality);
    const std::vector<render::View> plain = framesOf(damBreakView(subject.particles, subject.style), settings.frames);
    for (const NamedLook& look : kLooks) {
        if (look.quality != subject.quality) renderers = makeRenderers(context, subject.size, look.quality);
        subject.quality = look.quality;
        std::vector<render::View> frames = plain;
        for (render::View& frame : frames) look.add(frame);
        const render::View& view = frames.front();
        const std::vector<ExactWindow> exact = exactWindowsOf(look, settings, plain.front(), subject.size);
        const std::vector<DrawingTimes> times = measureDrawing(renderers, frames);
        for (std::size_t k = 0; k < renderers.size(); ++k) {
            render::Renderer& renderer = *renderers[k].renderer;
            LookRow& row = rows.emplace_back(LookRow{subject, look.name, times[k].draw});
            row.renderer = renderers[k].kind;
            row.error = errorOf(renderer.draw(view), renderer.visiblePoints(view), view, exact);
            row.timeRatio = row.draw / rows[k].draw;
            listener(rows);
        }
    }
    return rows;
}

std::vector<PictureRow> measurePictures(const PictureSettings& settings, render::Context* context,
                                        const RowsListener<PictureRow>& listener) {
    std::vector<PictureRow> rows;
    for (const render::Style style : kStyles)
        for (const render::PictureSize size : settings.sizes)
            for (const std::size_t particles : settings.particles) {
                DrawnView drawn{framesOf(damBreakView(particles, style), settings.frames), {}};
                drawn.exact = exactWindows(settings, drawn.frames.front(), size);
                for (const render::Quality quality : kQualities)
                    for (const PictureRow& row :
                         measurePicture(settings, context, {style, particles, size, quality}, drawn)) {
                        rows.push_back(row);
                        listener(rows);
                    }
            }
    return rows;
}

}  // namespace studies
