// Layers of pictures for compositing: depth, normals and ids against closed forms and against brute force over all
// particles; colors with alpha against the finished picture; and that each layer has the same bits however it is drawn.
#include "tests/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "tests/render/pictures.h"

using namespace pictures;
using render::Layers;
using render::LayerSelection;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr LayerSelection kAll{.image = true, .color = true, .points = true, .ids = true};

/// The view with ids that are not the particles' indices, and of which some need more than 16 bits.
render::View numbered(render::View view) {
    view.particleIds.resize(view.particles.size());
    for (std::size_t k = 0; k < view.particleIds.size(); ++k)
        view.particleIds[k] = static_cast<std::uint32_t>(1000 * k + 7);
    return view;
}

Layers layersOf(const render::View& view, const LayerSelection& wanted, Quality quality = Quality::normal) {
    Layers layers;
    render::Renderer(kSize, quality).draw(view, wanted, layers);
    return layers;
}

/// A cloud of particles with everything around it that a pixel may show.
render::View busyView(Style style) {
    render::View view = numbered(cloudWithObstacles(200));
    view.style = style;
    view.light.shadows = true;
    view.ambient.occlusion = 0.8F;
    view.surface = {0.04F, 8, 1.0F, 0.3F, 0.4F, 0.5F, 0.6F, 0.2F};
    view.exposure = 1.0F;
    view.ground->height = -0.3F;
    view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
    return view;
}

/// Calls visit(pixel index, ray through the pixel's center).
template <typename Visit>
void forEachPixel(const render::View& view, const Visit& visit) {
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            visit(static_cast<std::size_t>(y * kSize.width + x), oracle::pixelRay(view, kSize, x + 0.5, y + 0.5));
}

double decodedSrgb(int value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The linear color of the background behind a row of pixels.
glm::dvec3 backgroundOf(const render::View& view, std::size_t pixel) {
    const double y = static_cast<double>(pixel / static_cast<std::size_t>(kSize.width)) + 0.5;
    return glm::mix(glm::dvec3(view.background.top), glm::dvec3(view.background.bottom), y / kSize.height);
}

/// Whether two arrays are the same, byte by byte.
template <typename Value>
bool sameBytes(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

/// The number of the particle that a point of the surface belongs to, by trying all of them.
std::uint32_t numberAt(const render::View& view, const oracle::Hit& hit) {
    if (hit.kind != oracle::Hit::Kind::particle) return 0;
    std::size_t best = 0;
    double most = -1e300;
    const std::vector<oracle::Ball> balls = oracle::ballsOf(view);
    for (std::size_t k = 0; k < view.particles.size(); ++k) {
        const render::Sphere& particle = view.particles[k];
        const double off = glm::distance(hit.point, glm::dvec3(particle.center));
        double value = -std::abs(off - double(particle.radius));
        if (view.style == Style::metaballs) {
            const double share = glm::distance(hit.point, balls[k].center) / balls[k].reach;
            value = share < 1.0 ? balls[k].weight * std::pow(1.0 - share * share, 2.0) : 0.0;
        }
        if (value <= most) continue;
        most = value;
        best = k;
    }
    return 1 + view.particleIds[best];
}

}  // namespace

TEST_CASE("Depth and normals of a sphere have their closed form", "[layers]") {
    render::View view;
    view.particles.push_back({{0.0F, 0.0F, 0.0F}, 0.5F, {1.0F, 0.0F, 0.0F}});
    view.particleIds = {41};
    view.camera.eye = {0.0F, 0.0F, 3.0F};
    const Layers layers = layersOf(view, {.points = true, .ids = true});
    int seen = 0;
    forEachPixel(view, [&](std::size_t pixel, const oracle::Ray& ray) {
        // |eye + t d|^2 = r^2 with |eye| = 3: t = -b - sqrt(b^2 - 9 + r^2), b = eye.d.
        const double b = 3.0 * ray.direction.z;
        const double root = b * b - 9.0 + 0.25;
        if (std::abs(root) < 1e-4) return;  // at the outline rounding decides
        CAPTURE(pixel);
        const render::VisiblePoint& point = layers.points[pixel];
        CHECK((point.depth >= 0.0F) == (root > 0.0));
        CHECK(layers.ids[pixel] == (root > 0.0 ? 42 : 0));
        if (root < 0.0) return;
        const double t = -b - std::sqrt(root);
        // Single precision, 6e-8, of lengths up to 3 m, over the slope at which the ray meets the sphere.
        const double tolerance = 1e-6 / std::sqrt(root);
        CHECK(std::abs(double(point.depth) + t * ray.direction.z) < tolerance);
        const glm::dvec3 normal = (glm::dvec3(0.0, 0.0, 3.0) + t * ray.direction) / 0.5;
        CHECK(glm::distance(normal, glm::dvec3(point.normal)) < 4.0 * tolerance);
        ++seen;
    });
    CHECK(seen > 500);
}

TEST_CASE("Ids are those that brute force finds", "[layers]") {
    for (const Style style : {Style::spheres, Style::metaballs})
        for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth})
            for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
                if (style == Style::spheres && skin == render::Skin::smooth) continue;
                render::View view = numbered(cloudWithObstacles(60));
                view.style = style;
                view.field.skin = skin;
                view.camera.projection = projection;
                view.camera.halfHeight = 2.0F;
                const Layers layers = layersOf(view, {.ids = true}, Quality::final);
                const oracle::Scene scene(view);
                int wrong = 0;
                int particles = 0;
                forEachPixel(view, [&](std::size_t pixel, const oracle::Ray& ray) {
                    const std::uint32_t expected = numberAt(view, oracle::trace(scene, ray));
                    particles += expected != 0 ? 1 : 0;
                    wrong += layers.ids[pixel] != expected ? 1 : 0;
                });
                CAPTURE(static_cast<int>(style), static_cast<int>(skin), static_cast<int>(projection), particles,
                        wrong);
                CHECK(particles > 500);
                // Rays that pass an outline, or the line where two balls are equally strong, closer than single
                // precision tells; counted once: 0 to 1.
                CHECK(wrong <= 3);
            }
}

TEST_CASE("The layer of colors over the background is the finished picture", "[layers]") {
    for (const Style style : {Style::spheres, Style::metaballs})
        for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
            const render::View view = busyView(style);
            const Layers layers = layersOf(view, kAll, quality);
            double largest = 0.0;
            int partly = 0;
            for (std::size_t pixel = 0; pixel < layers.color.size(); ++pixel) {
                const glm::vec4& color = layers.color[pixel];
                partly += color.a > 0.1F && color.a < 0.9F ? 1 : 0;
                const glm::dvec3 over = glm::dvec3(color) + (1.0 - double(color.a)) * backgroundOf(view, pixel);
                for (int channel = 0; channel < 3; ++channel) {
                    const double steps = encodedSteps(std::clamp(over[channel], 0.0, 1.0));
                    const double shown = layers.image.rgb[3 * pixel + static_cast<std::size_t>(channel)];
                    const double dither = oracle::ditherThreshold(static_cast<int>(pixel) % layers.image.width,
                                                                  static_cast<int>(pixel) / layers.image.width);
                    largest = std::max(largest, std::abs(steps + dither - 0.5 - shown));
                }
            }
            CAPTURE(static_cast<int>(style), static_cast<int>(quality), largest, partly);
            CHECK(partly > 100);
            // Half a step of rounding; 0.15 because the background of a sample is taken at its own height, which is up
            // to 3/8 pixel from the middle, of 75 pixels over which it changes by 90 steps.
            CHECK(largest <= 0.65);
        }
}

TEST_CASE("A file with straight alpha gives the finished picture back within its 8 bits", "[layers]") {
    const render::View view = busyView(Style::metaballs);
    const Layers layers = layersOf(view, kAll);
    for (std::size_t pixel = 0; pixel < layers.color.size(); ++pixel) {
        // As `rgba` is encoded: what is tested is that these 8 bits suffice.
        const glm::vec4& color = layers.color[pixel];
        const double alpha = std::round(255.0 * double(color.a)) / 255.0;
        for (int channel = 0; channel < 3; ++channel) {
            const double straight = color.a > 0.0F ? double(color[channel]) / double(color.a) : 0.0;
            const double rounded = decodedSrgb(static_cast<int>(std::round(encodedSteps(std::min(straight, 1.0)))));
            const double over = alpha * rounded + (1.0 - alpha) * backgroundOf(view, pixel)[channel];
            const double shown = layers.image.rgb[3 * pixel + static_cast<std::size_t>(channel)];
            CAPTURE(pixel, channel, over, shown);
            // Half a step of color, half a step of the picture, 0.15 as above, and half a step of alpha, whose effect
            // is at most 1/510 of the difference of two linear colors: less than one step where colors are not dark.
            CHECK(std::abs(encodedSteps(over) - shown) <= 2.0);
        }
    }
}

TEST_CASE("Every layer has the same bits, whatever else is drawn, with any number of threads", "[layers]") {
    for (const Style style : {Style::spheres, Style::metaballs})
        for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
            CAPTURE(static_cast<int>(style), static_cast<int>(quality));
            const render::View view = busyView(style);
            const Layers all = layersOf(view, kAll, quality);
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
            CHECK(layersOf(view, {.image = true}, quality).image.rgb == all.image.rgb);
            CHECK(sameBytes(layersOf(view, {.color = true}, quality).color, all.color));
            CHECK(sameBytes(layersOf(view, {.points = true}, quality).points, all.points));
            CHECK(sameBytes(layersOf(view, {.ids = true}, quality).ids, all.ids));
            CHECK(drawn(view, kSize, quality).rgb == all.image.rgb);
        }
}

#ifdef RENDER_HAS_OPENGL
TEST_CASE("OpenGL draws points as they are beside the image, and refuses what it does not draw", "[layers]") {
    for (const Style style : {Style::spheres, Style::metaballs}) {
        const render::View view = busyView(style);
        render::Renderer& renderer = openGlRenderer(kSize, Quality::draft);
        Layers alone, both;
        renderer.draw(view, {.points = true}, alone);
        renderer.draw(view, {.image = true, .points = true}, both);
        CHECK(sameBytes(alone.points, both.points));
        CHECK(both.image.rgb == renderer.draw(view).rgb);
        const Layers byCpu = layersOf(view, {.points = true}, Quality::draft);
        int same = 0;
        for (std::size_t k = 0; k < byCpu.points.size(); ++k)
            same += std::abs(byCpu.points[k].depth - both.points[k].depth) < 1e-3F ? 1 : 0;
        // All but the few at outlines, which rounding decides.
        CHECK(same > kSize.width * kSize.height - 20);
        CHECK_THROWS_AS(renderer.draw(view, {.color = true}, alone), std::logic_error);
        CHECK_THROWS_AS(renderer.draw(view, {.ids = true}, alone), std::logic_error);
    }
}
#endif

TEST_CASE("Layers that are not asked for take no memory", "[layers]") {
    const render::View view = busyView(Style::metaballs);
    const Layers depth = layersOf(view, {.points = true});
    CHECK(depth.image.rgb.capacity() + depth.color.capacity() + depth.ids.capacity() == 0);
    const Layers image = layersOf(view, {.image = true});
    CHECK(image.points.capacity() + image.color.capacity() + image.ids.capacity() == 0);
}

TEST_CASE("Particles keep their ids when strays are left out", "[layers]") {
    render::View view = numbered(cloudWithObstacles(60));
    const Layers before = layersOf(view, {.ids = true});
    view.particles.insert(view.particles.begin(), {{-900.0F, 0.0F, 900.0F}, 0.1F, {1.0F, 1.0F, 1.0F}});
    view.particleIds.insert(view.particleIds.begin(), 5);
    CHECK(layersOf(view, {.ids = true}).ids == before.ids);
    view.particleIds.pop_back();
    CHECK_THROWS_AS(layersOf(view, {.ids = true}), std::logic_error);
}

TEST_CASE("An empty view is transparent and has no surface", "[layers]") {
    render::View view;
    const Layers layers = layersOf(view, kAll);
    const auto isClear = [](const glm::vec4& pixel) { return pixel == glm::vec4(0.0F); };
    CHECK(std::ranges::all_of(layers.color, isClear));
    CHECK(std::ranges::all_of(layers.points, [](const auto& point) { return point.depth == -1.0F; }));
    CHECK(std::ranges::all_of(layers.ids, [](std::uint32_t id) { return id == 0; }));
}
