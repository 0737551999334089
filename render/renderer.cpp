// From view to image: prepare, cast the metaballs, color the pixels, hand them to OpenGL, read them back, draw the
// overlay. In final quality metaballs are cast and pixels colored nine times, with the rays moved within the pixel.
#include "render/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/task_group.h>

#include "render/cpu/picture_pass.h"
#include "render/opengl/gl.h"
#include "render/overlay/draw_overlay.h"
#include "render/picture/system_error.h"
#include "render/prepare/strays.h"

namespace render {

namespace {

/// Texels along the longer side of the light's depth map, which covers all particles but strays.
int depthMapTexels(Quality quality) {
    return quality == Quality::final ? 2048 : 1024;
}

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Throws for numbers that are not finite. They come from a bug in the caller, and would break the sorting of spheres
/// into tiles.
void requireFinite(const View& view) {
    for (std::size_t k = 0; k < view.particles.size(); ++k) {
        const Sphere& s = view.particles[k];
        if (finite(s.center) && std::isfinite(s.radius) && finite(s.color)) continue;
        throw std::logic_error(fmt::format(
            "render: particle {} of {} is at ({}, {}, {}) with radius {} and color ({}, {}, {})", k,
            view.particles.size(), s.center.x, s.center.y, s.center.z, s.radius, s.color.x, s.color.y, s.color.z));
    }
    if (!finite(view.camera.eye) || !finite(view.camera.target) || !finite(view.light.toLight)) {
        throw std::logic_error("render: the camera or the light has a coordinate that is not finite");
    }
    if (dot(view.light.toLight, view.light.toLight) == 0.0F)
        throw std::logic_error("render: the light has no direction");
}

PictureSize checkedSize(PictureSize size) {
    if (size.width > 0 && size.height > 0) return size;
    throw std::logic_error(fmt::format("render: a picture of {} x {} pixels", size.width, size.height));
}

/// The samples of a pixel, one pass over the picture for each element. In final quality a regular grid of 3 x 3
/// samples, each clamped, whose mean is taken in linear light.
std::vector<Sampling> samplingsOf(Quality quality) {
    if (quality == Quality::draft) return {{.isSparse = true}};
    if (quality == Quality::normal) return {{.samples = 4, .isSparse = true}};
    std::vector<Sampling> samplings;
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column)
            samplings.push_back({.offset = glm::vec2(column, row) / 3.0F, .index = samplings.size(), .count = 9});
    return samplings;
}

}  // namespace

struct Renderer::Parts {
    Parts(Context& context_, PictureSize size_, Quality quality_)
        : context(context_),
          size(checkedSize(size_)),
          padded{kTileSize * tilesAlong(size_.width), kTileSize * tilesAlong(size_.height)},
          quality(quality_),
          target(context_.gl(), padded.width, padded.height),
          pixels(static_cast<std::size_t>(padded.width) * static_cast<std::size_t>(padded.height)) {}

    void cast(const View& view, const Sampling& sampling) {
        timed(times.shadow, [&] { pass.castShadow(view, sampling); });
        timed(times.cast, [&] { pass.castMetaballs(sampling); });
    }

    void color(const View& view) {
        for (const Sampling& sampling : samplingsOf(quality)) {
            cast(view, sampling);
            timed(times.color, [&] { pass.color(view, sampling, pixels); });
        }
    }

    std::vector<VisiblePoint> visiblePoints(const View& view) {
        const Sampling sampling{.isSparse = quality != Quality::final};
        cast(view, sampling);
        return pass.visiblePoints(view, sampling);
    }

    /// Prepares everything that does not depend on the sampling.
    /// @return the view without its strays, from which the picture is drawn; it may refer to `view`
    const View& prepare(const View& view) {
        times = {};
        const CameraFrame frame = cameraFrame(view.camera, size);
        timed(times.bin, [&] { near = withoutStrays(view, frame); });
        const View& drawn = near ? *near : view;
        pass.prepare(frame, drawn, depthMapTexels(quality), times);
        return drawn;
    }

    Image readBack(Image image) {
        image.width = size.width;
        image.height = size.height;
        image.rgb.resize(image.byteCount());
        // Rows of pixels are packed from four bytes per pixel to three by other threads while OpenGL hands over the
        // next rows.
        tbb::task_group packing;
        constexpr int kBand = 64;  // rows per task; chosen: they fit into a core's cache
        for (int row = 0; row < size.height; row += kBand) {
            const int rows = std::min(kBand, size.height - row);
            target.readRows(row, rows, rowOf(row));
            packing.run([this, &image, row, rows] { packRows(row, rows, image); });
        }
        packing.wait();
        checkGl(context.gl(), "drawing a frame");
        return image;
    }

    PixelColor* rowOf(int row) {
        return &pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(padded.width)];
    }

    void packRows(int first, int rows, Image& image) {
        const auto last = static_cast<std::size_t>(size.width) - 1;
        for (int row = first; row < first + rows; ++row) {
            const PixelColor* from = rowOf(row);
            std::uint8_t* to = &image.rgb[3 * (last + 1) * static_cast<std::size_t>(row)];
            // Copies four bytes for each pixel but the last: the fourth byte is overwritten by the next pixel.
            static_assert(std::endian::native == std::endian::little);
            for (std::size_t k = 0; k < last; ++k) std::memcpy(to + 3 * k, &from[k], sizeof(PixelColor));
            std::memcpy(to + 3 * last, &from[last], 3);
        }
    }

    Context& context;
    PictureSize size;
    PictureSize padded;
    Quality quality;
    std::optional<View> near;  // the last view without its strays, if it had any
    PicturePass pass;
    Target target;
    std::vector<PixelColor> pixels;  // pixels of whole tiles, row by row
    DrawTimes times;
};

Renderer::Renderer(Context& context, PictureSize size, Quality quality) {
    const CurrentContext current(context);
    parts_ = std::make_unique<Parts>(context, size, quality);
    checkGl(context.gl(), "setting the renderer up");
}

Renderer::~Renderer() {
    try {
        const CurrentContext current(parts_->context);
        parts_.reset();
    } catch (const SystemError&) {
        // OpenGL objects cannot be deleted without their context. They are freed together with the context.
        static_cast<void>(parts_.release());
    }
}

Image Renderer::draw(const View& view, Image old) {
    requireFinite(view);
    const CurrentContext current(parts_->context);
    parts_->color(parts_->prepare(view));
    timed(parts_->times.openGl, [&] { parts_->target.put(parts_->pixels); });
    Image image;
    timed(parts_->times.readBack, [&] { image = parts_->readBack(std::move(old)); });
    drawOverlay(image, view.overlay, view.camera);
    return image;
}

std::vector<VisiblePoint> Renderer::visiblePoints(const View& view) {
    requireFinite(view);
    return parts_->visiblePoints(parts_->prepare(view));
}

const DrawTimes& Renderer::times() const {
    return parts_->times;
}

}  // namespace render
