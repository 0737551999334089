// From view to image: check, prepare, draw with one of the two renderers, draw the overlay. A view with blur is
// prepared and drawn once for each sample of the pixels, as what that sample sees.
#include "render/renderer.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "render/cpu/cpu_renderer.h"
#include "render/opengl/opengl_renderer.h"
#include "render/overlay/draw_overlay.h"
#include "render/picture/pixel_samples.h"
#include "render/prepare/view_renderer.h"

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

}  // namespace

struct Renderer::Parts {
    void draw(const View& view, const SampleRange& samples, const LayerSelection& wanted, Layers& layers) {
        if (!wanted.any()) return;
        requireFinite(view);
        settings.isShaded = wanted.isShaded();
        prepareView(view, settings, prepared, times);
        renderer->draw(prepared, samples, wanted, layers, times);
    }

    /// Draws everything in final quality. What has no color shows the middles of the pixels at the picture's own
    /// moment, from the middle of the lens.
    void drawFinal(const View& view, const LayerSelection& wanted, Layers& layers) {
        const SampleRange all{0, view.samplesPerAxis * view.samplesPerAxis, view.samplesPerAxis};
        const bool hasMiddles = view.samplesPerAxis % 2 == 1;
        if (!wanted.isShaded() || (hasMiddles && !hasBlur(view))) return draw(view, all, wanted, layers);
        draw(view, all, {.points = wanted.points, .ids = wanted.ids}, layers);
        const LayerSelection shaded{.image = wanted.image, .color = wanted.color};
        if (!hasBlur(view)) return draw(view, all, shaded, layers);
        View sampled = view;
        for (int k = 0; k < all.count(); ++k) {
            setSample(view, k, sampled);
            draw(sampled, {k, k + 1, all.perAxis, false}, shaded, layers);
        }
    }

    Quality quality = Quality::normal;
    PrepareSettings settings;
    std::unique_ptr<ViewRenderer> renderer;
    PreparedView prepared;
    DrawTimes times;
};

Renderer::Renderer(PictureSize size, Quality quality) : parts_(std::make_unique<Parts>()) {
    parts_->quality = quality;
    parts_->settings = {checkedSize(size), depthMapTexels(quality), 1};
    parts_->renderer = std::make_unique<CpuRenderer>(size, quality);
}

Renderer::Renderer(Context& context, PictureSize size, Quality quality) : parts_(std::make_unique<Parts>()) {
    parts_->quality = quality;
    parts_->settings = {checkedSize(size), depthMapTexels(quality), 2};
    parts_->renderer = makeOpenGlRenderer(context, size, quality);
}

Renderer::~Renderer() = default;

Image Renderer::draw(const View& view, Image old) {
    Layers layers;
    layers.image = std::move(old);
    draw(view, {.image = true}, layers);
    return std::move(layers.image);
}

void Renderer::draw(const View& view, const LayerSelection& wanted, Layers& layers) {
    if (wanted.ids && view.particleIds.size() != view.particles.size())
        throw std::logic_error(
            fmt::format("render: {} particles have {} ids", view.particles.size(), view.particleIds.size()));
    parts_->times = {};
    if (parts_->quality == Quality::final)
        parts_->drawFinal(view, wanted, layers);
    else
        parts_->draw(view, {}, wanted, layers);
    if (wanted.image) drawOverlay(layers.image, view.overlay, view.camera);
}

std::vector<VisiblePoint> Renderer::visiblePoints(const View& view) {
    Layers layers;
    draw(view, {.points = true}, layers);
    return std::move(layers.points);
}

const DrawTimes& Renderer::times() const {
    return parts_->times;
}

}  // namespace render
