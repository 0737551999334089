// Shared by the tests of the renderers: views to draw, what draws them, and the comparison of two pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <ostream>
#include <random>
#include <vector>

#include "render/picture/image.h"
#include "render/picture/view.h"
#include "render/renderer.h"
#include "studies/oracle/oracle.h"

namespace pictures {

/// sRGB encoding of a linear value from 0 to 1, not rounded, in 8-bit steps.
inline double encodedSteps(double linear) {
    return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

/// How far two pictures are apart, in 8-bit steps of a channel.
struct Difference {
    bool sameSize = true;
    int largest = 0;
    int worstX = 0;
    int worstY = 0;
    double mean = 0.0;
    double share = 0.0;  ///< of the pixels that differ by more than a limit in some channel
};

inline std::ostream& operator<<(std::ostream& out, const Difference& d) {
    return out << "largest " << d.largest << " at (" << d.worstX << ", " << d.worstY << "), mean " << d.mean
               << ", share " << d.share;
}

/// @param limit  up to how many steps two pixels count as equal
inline Difference compare(const render::Image& a, const render::Image& b, int limit) {
    Difference result;
    result.sameSize = a.width == b.width && a.height == b.height && a.rgb.size() == b.rgb.size();
    if (!result.sameSize) return result;
    double sum = 0.0;
    int over = 0;
    for (std::size_t pixel = 0; 3 * pixel < a.rgb.size(); ++pixel) {
        int worst = 0;
        for (std::size_t k = 3 * pixel; k < 3 * pixel + 3; ++k) {
            const int step = std::abs(int(a.rgb[k]) - int(b.rgb[k]));
            sum += step;
            worst = std::max(worst, step);
        }
        over += worst > limit ? 1 : 0;
        if (worst <= result.largest) continue;
        result.largest = worst;
        result.worstX = static_cast<int>(pixel % static_cast<std::size_t>(a.width));
        result.worstY = static_cast<int>(pixel / static_cast<std::size_t>(a.width));
    }
    result.mean = sum / static_cast<double>(a.rgb.size());
    result.share = 3.0 * over / static_cast<double>(a.rgb.size());
    return result;
}

inline render::Image fromOracle(const render::View& view, render::PictureSize size, int samplesPerAxis) {
    oracle::Picture picture = oracle::draw(view, size, samplesPerAxis);
    return {picture.width, picture.height, std::move(picture.rgb)};
}

inline render::Image drawn(const render::View& view, render::PictureSize size, render::Quality quality) {
    return render::Renderer(size, quality).draw(view);
}

/// What draws a picture.
enum class By { cpu, openGl };

inline std::ostream& operator<<(std::ostream& out, By by) {
    return out << (by == By::cpu ? "by the CPU" : "by OpenGL");
}

/// The renderers of this build. A test that both are to pass begins with
///     const By by = GENERATE(from_range(renderers()));
inline std::vector<By> renderers() {
#ifdef RENDER_HAS_OPENGL
    return {By::cpu, By::openGl};
#else
    return {By::cpu};
#endif
}

/// The context that all renderers of the tests share.
inline render::Context& openGlContext() {
    static render::Context context(render::Device{});
    return context;
}

/// A renderer that has drawn nothing yet.
inline std::unique_ptr<render::Renderer> makeRenderer(By by, render::PictureSize size, render::Quality quality) {
    if (by == By::cpu) return std::make_unique<render::Renderer>(size, quality);
    return std::make_unique<render::Renderer>(openGlContext(), size, quality);
}

/// The renderer in OpenGL of a size and quality. It is kept to the end, because it takes about a second to compile the
/// shaders of a look.
inline render::Renderer& openGlRenderer(render::PictureSize size, render::Quality quality) {
    struct Kept {
        render::PictureSize size;
        render::Quality quality;
        std::unique_ptr<render::Renderer> renderer;
    };
    openGlContext();  // so that it outlives the renderers
    static std::vector<Kept> kept;
    for (const Kept& one : kept)
        if (one.size == size && one.quality == quality) return *one.renderer;
    kept.push_back({size, quality, makeRenderer(By::openGl, size, quality)});
    return *kept.back().renderer;
}

inline render::Image drawn(By by, const render::View& view, render::PictureSize size, render::Quality quality) {
    return by == By::cpu ? drawn(view, size, quality) : openGlRenderer(size, quality).draw(view);
}

/// How far a renderer is from the oracle, both with one sample a pixel.
/// @param limit  up to how many steps two pixels count as equal
inline Difference differenceFromOracle(By by, const render::View& view, render::PictureSize size, int limit) {
    return compare(drawn(by, view, size, render::Quality::draft), fromOracle(view, size, 1), limit);
}

/// Particles of different sizes in a box of 3 x 2 x 3 m above the ground, with light and sky of different colors.
inline render::View cloud(int count, unsigned seed = 7) {
    render::View view;
    std::mt19937 random(seed);
    const auto uniform = [&random] { return static_cast<float>(random()) / 4294967296.0F; };
    for (int k = 0; k < count; ++k) {
        // Within braces every compiler evaluates the random numbers from left to right.
        const glm::vec3 at{3.0F * uniform() - 1.5F, 2.0F * uniform() + 0.2F, 3.0F * uniform() - 1.5F};
        view.particles.push_back({at, 0.08F + 0.1F * uniform(), {uniform(), uniform(), uniform()}});
    }
    view.camera.eye = {2.0F, 3.0F, 5.0F};
    view.camera.target = {0.0F, 0.9F, 0.0F};
    view.light.toLight = glm::normalize(glm::vec3(0.5F, 0.8F, 0.3F));
    view.light.color = {0.9F, 0.85F, 0.8F};
    view.light.shadows = false;
    view.ambient = {{0.2F, 0.25F, 0.3F}, {0.12F, 0.1F, 0.1F}};
    view.surface = {0.05F, 5};
    view.background = {{0.3F, 0.5F, 0.8F}, {0.7F, 0.6F, 0.5F}};
    view.ground = render::Ground{0.0F, {0.5F, 0.5F, 0.45F}, {0.0F, 0.0F, 0.0F}, 6.0F};
    return view;
}

/// The cloud with a sphere and a box beside it. The box does not touch the ground, nor do its edges run through the
/// middles of pixels, where rounding would decide what is seen.
inline render::View cloudWithObstacles(int count) {
    render::View view = cloud(count);
    view.sphereObstacles.push_back({{-1.4F, 0.5F, 1.4F}, 0.5F, {0.8F, 0.2F, 0.2F}});
    view.boxObstacles.push_back({{0.81F, 0.01F, 1.2F}, {1.6F, 0.7F, 2.0F}, {0.2F, 0.3F, 0.7F}});
    return view;
}

}  // namespace pictures
