// What an open shutter and a wide lens blur in final quality: closed forms for a sphere that moves and for one out of
// focus, the oracle with the same moments and with many more, and what must stay as it is without blur.
#include "tests/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

#include <tbb/global_control.h>

#include "render/picture/camera_frame.h"
#include "render/picture/pixel_samples.h"
#include "studies/oracle/blur.h"
#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Layers;
using render::Quality;
using render::View;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

/// Opens the shutter of a view for some seconds, in which particles have velocities and everything else is at rest.
void openShutter(View& view, float seconds, std::vector<glm::vec3> velocities) {
    view.shutter = render::Shutter{std::move(velocities), {}};
    for (int k = 0; k < view.samplesPerAxis * view.samplesPerAxis; ++k)
        view.shutter->moments.push_back({seconds * static_cast<float>(render::sampleTime(k, view.samplesPerAxis)),
                                         view.camera, view.sphereObstacles, view.boxObstacles, view.meshObstacles,
                                         view.edges});
}

/// Particles that are white from all sides on black, seen along -z from (0, 0, 10).
View whiteOnBlack(std::vector<render::Sphere> particles) {
    View view;
    view.particles = std::move(particles);
    for (render::Sphere& particle : view.particles) particle.color = glm::vec3(1.0F);
    view.light.color = glm::vec3(0.0F);
    view.ambient = {glm::vec3(1.0F), glm::vec3(1.0F)};
    view.background = {glm::vec3(0.0F), glm::vec3(0.0F)};
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    view.camera.target = glm::vec3(0.0F);
    view.camera.verticalFov = 0.5F;
    return view;
}

/// The cloud with obstacles of all kinds, of which particles fly around the middle and obstacles and camera move.
View movingCloud(int count, int samplesPerAxis) {
    View view = cloudWithObstacles(count);
    view.samplesPerAxis = samplesPerAxis;
    view.light.shadows = true;
    view.ambient.occlusion = 0.6F;
    view.meshObstacles.push_back({meshSphere(0.3, 24), glm::mat3(1.0F), {1.2F, 1.6F, 1.0F}, {0.9F, 0.7F, 0.1F}});
    view.camera.aperture = 0.15F;
    std::vector<glm::vec3> velocities;
    for (const render::Sphere& particle : view.particles)
        velocities.push_back({-particle.center.z, 0.5F, particle.center.x});
    openShutter(view, 0.1F, velocities);
    for (render::Moment& moment : view.shutter->moments) {
        moment.camera.eye.x += 2.0F * moment.time;
        for (render::SphereObstacle& sphere : moment.sphereObstacles) sphere.center.y += 3.0F * moment.time;
        for (render::BoxObstacle& box : moment.boxObstacles) box.maximum.y += 2.0F * moment.time;
        for (render::MeshObstacle& mesh : moment.meshObstacles) mesh.position.x += 2.0F * moment.time;
    }
    return view;
}

double linearOf(const render::Image& image, int x, int y) {
    const double v = image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))] / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

render::Image blurredByOracle(const View& view, int samplesPerAxis) {
    oracle::Picture picture =
        oracle::drawBlurred(oracle::BlurredScene(view), kSize, {0, 0, kSize.width, kSize.height}, samplesPerAxis);
    return {picture.width, picture.height, std::move(picture.rgb)};
}

/// Sum of the light of a white picture on black, its mean position (pixels) and its variance along x (pixels^2).
struct Moments {
    double light = 0.0;
    glm::dvec2 mean{0.0};
    double variance = 0.0;
};

Moments momentsOf(const render::Image& image) {
    Moments found;
    double squares = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double light = linearOf(image, x, y);
            found.light += light;
            found.mean += light * glm::dvec2(x + 0.5, y + 0.5);
            squares += light * (x + 0.5) * (x + 0.5);
        }
    found.mean /= found.light;
    found.variance = squares / found.light - found.mean.x * found.mean.x;
    return found;
}

}  // namespace

TEST_CASE("The samples of a pixel are spread evenly in it, over the shutter's time and over the lens", "[blur]") {
    for (const int perAxis : {1, 2, 3, 4, 5, 8}) {
        const int count = perAxis * perAxis;
        std::set<int> moments;
        std::set<std::pair<float, float>> onLens;
        glm::dvec2 middle(0.0);
        glm::dvec2 sumOfLens(0.0);
        double inner = 0.0;
        double timeByX = 0.0;
        std::array<double, 3> timeByLens{};  // by its coordinates and the distance from its middle
        std::array<double, 3> squares{};
        for (int k = 0; k < count; ++k) {
            const render::PixelSample sample = render::pixelSample(k, perAxis);
            CHECK(std::abs(sample.offset.x - (static_cast<float>(k % perAxis) + 0.5F) / static_cast<float>(perAxis) +
                           0.5F) < 1e-6F);
            moments.insert(static_cast<int>(std::floor((sample.time + 0.5) * count)));
            onLens.insert({sample.onLens.x, sample.onLens.y});
            middle += glm::dvec2(sample.offset);
            sumOfLens += glm::dvec2(sample.onLens);
            inner += glm::dot(glm::dvec2(sample.onLens), glm::dvec2(sample.onLens)) / count;
            timeByX += sample.time * double(sample.offset.x) / count;
            const double radius = glm::length(glm::dvec2(sample.onLens)) - 2.0 / 3.0;
            const std::array<double, 3> lens{double(sample.onLens.x), double(sample.onLens.y), radius};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                timeByLens[axis] += sample.time * lens[axis] / count;
                squares[axis] += lens[axis] * lens[axis] / count;
            }
            CHECK(glm::length(sample.onLens) <= 1.0F);
        }
        CAPTURE(perAxis, inner, timeByX);
        CHECK(moments.size() == static_cast<std::size_t>(count));
        CHECK(*moments.begin() == 0);
        CHECK(*moments.rbegin() == count - 1);
        CHECK(onLens.size() == static_cast<std::size_t>(count));
        CHECK(glm::length(middle) < 1e-5);
        CHECK(glm::length(sumOfLens) < 1e-5);
        if (perAxis < 3) continue;
        // The mean square of the distance from the middle of an evenly covered disc is 1/2.
        CHECK(std::abs(inner - 0.5) < 0.006);
        // The variance of evenly spread moments is 1/12, and so is that of the places.
        CHECK(std::abs(timeByX) < 0.06 / 12.0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double correlation = timeByLens[axis] / std::sqrt(squares[axis] / 12.0);
            CAPTURE(axis, correlation);
            CHECK(std::abs(correlation) < (perAxis < 5 ? 0.31 : 0.18));
        }
    }
}

TEST_CASE("Nine samples of final quality are the grid of 3 x 3 in the order of rows", "[blur]") {
    int k = 0;
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column)
            CHECK(render::pixelSample(k++, 3).offset == glm::vec2(column, row) / 3.0F);
}

TEST_CASE("A moving sphere covers a pixel for the share of the moments at which it is there", "[blur]") {
    const By by = GENERATE(from_range(renderers()));
    View view = whiteOnBlack({{{0.0F, 0.0F, 0.0F}, 0.5F}});
    view.camera.projection = render::Projection::orthographic;
    view.camera.halfHeight = 1.5F;
    // 25 pixels per meter: the sphere has a radius of 12.5 pixels and moves by 15 while the shutter is open.
    const double scale = kSize.height / (2.0 * 1.5);
    openShutter(view, 0.1F, {{6.0F, 0.0F, 0.0F}});
    const render::Image image = drawn(by, view, kSize, Quality::final);
    int wrong = 0;
    double ofLimit = 0.0;
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
            int covered = 0;
            double nearest = 1e300;  // distance of a sample from the outline, pixels
            for (int k = 0; k < 9; ++k) {
                const render::PixelSample sample = render::pixelSample(k, 3);
                const glm::dvec2 at(x + 0.5 + double(sample.offset.x) - 60.5 - 0.6 * sample.time * scale,
                                    y + 0.5 + double(sample.offset.y) - 37.5);
                const double inside = 0.5 * scale - glm::length(at);
                nearest = std::min(nearest, std::abs(inside));
                covered += inside > 0.0 ? 1 : 0;
            }
            const double dithered = encodedSteps(covered / 9.0) + oracle::ditherThreshold(x, y);
            const int expected = std::min(static_cast<int>(std::floor(dithered)), 255);
            const int shown = image.rgb[static_cast<std::size_t>(3 * (y * kSize.width + x))];
            // Rounding decides on samples on the outline, and on colors between two steps.
            if (nearest > 1e-3 && std::abs(shown - expected) > 1) ++wrong;
            // The limit of many moments in the middle row: the share of the time at which |x - 15 t| < 12.5 pixels.
            if (y != 37) continue;
            const double from = std::clamp((x + 0.5 - 60.5 - 12.5) / 15.0, -0.5, 0.5);
            const double to = std::clamp((x + 0.5 - 60.5 + 12.5) / 15.0, -0.5, 0.5);
            ofLimit = std::max(ofLimit, std::abs(linearOf(image, x, y) - (to - from)));
        }
    CAPTURE(by, wrong, ofLimit);
    CHECK(wrong == 0);
    // Nine moments in the middles of equal parts are off by half a part at each outline, and a pixel's width of 1/15 of
    // the time is not a point: 1/18 + 1/30. The sphere is wider than its way, so that no pixel has both outlines.
    CHECK(ofLimit < 1.0 / 18.0 + 1.0 / 30.0);
    CHECK(ofLimit > 0.01);
}

TEST_CASE("A sphere in the plane of focus keeps its pixels, whatever the lens", "[blur]") {
    const By by = GENERATE(from_range(renderers()));
    View view = whiteOnBlack({{{0.3F, 0.2F, 0.0F}, 0.4F}, {{-1.0F, -0.5F, 0.0F}, 0.2F}});
    const render::Image sharp = drawn(by, view, kSize, Quality::final);
    view.camera.aperture = 0.2F;
    const render::Image focused = drawn(by, view, kSize, Quality::final);
    // The outline lies up to 0.4^2/10 m before the plane in focus, whose blur has a radius of 0.1 (1/9.984 - 1/10) of
    // the picture's plane, 147 pixels per unit: 0.024 pixels. Of the nine samples of a pixel, some of those that are so
    // near to the outline change sides.
    const Difference difference = compare(focused, sharp, 4);
    CAPTURE(by, difference);
    CHECK(difference.share * kPixels <= 25);
    CHECK(difference.mean < 0.1);
    // Six meters behind, the same lens blurs what has the same size on the picture.
    view.camera.focus = 4.0F;
    CHECK(compare(drawn(by, view, kSize, Quality::final), sharp, 4).share * kPixels > 100);
}

TEST_CASE("A sphere out of focus is blurred to a thin lens' circle of confusion", "[blur]") {
    const By by = GENERATE(from_range(renderers()));
    for (const float depth : {14.0F, 7.0F}) {
        const int perAxis = GENERATE(3, 6);
        View view = whiteOnBlack({{{0.0F, 0.0F, 10.0F - depth}, 0.06F * depth}});
        view.samplesPerAxis = perAxis;
        const Moments sharp = momentsOf(drawn(by, view, kSize, Quality::final));
        view.camera.aperture = 2.5F;
        view.camera.focus = 10.0F;
        const render::Image image = drawn(by, view, kSize, Quality::final);
        const Moments blurred = momentsOf(image);
        // A lens of diameter A that is in focus at f shows a point at d as a circle of the diameter A |d - f|/(d f) on
        // the picture's plane at view depth 1.
        const double perUnit = kSize.height / (2.0 * std::tan(0.25));
        const double outline = (1.0 - 0.06 * 0.06) * double(depth);  // where the tangents from the eye touch
        const double circle = 2.5 * std::abs(outline - 10.0) / (outline * 10.0) * perUnit;
        CAPTURE(by, depth, perAxis, circle, sharp.variance, blurred.variance, blurred.mean.x, blurred.mean.y);
        REQUIRE(circle > 10.0);
        // No light is lost; the middle stays.
        CHECK(std::abs(blurred.light / sharp.light - 1.0) < 0.02);
        CHECK(glm::length(blurred.mean - sharp.mean) < 0.05);
        // Sample k shows the sphere moved by the circle's radius times its point of the lens, to the left before the
        // plane in focus, and by its own place in the pixel.
        double places = 0.0;
        double moved = 0.0;
        for (int k = 0; k < perAxis * perAxis; ++k) {
            const render::PixelSample sample = render::pixelSample(k, perAxis);
            const double way = std::copysign(0.5 * circle, outline - 10.0) * double(sample.onLens.x);
            places += double(sample.offset.x) * double(sample.offset.x) / (perAxis * perAxis);
            moved += std::pow(way - double(sample.offset.x), 2.0) / (perAxis * perAxis);
        }
        const double growth = blurred.variance - sharp.variance;
        CAPTURE(growth, moved - places);
        // A point of the lens sees the sphere from the side, by an angle whose tangent is up to 1.25/7, 0.09 in the
        // mean of squares along x, and as much wider as that squared: 0.8 % of its width, 1.6 % of its variance of 20.
        // That each copy is sampled once a pixel makes its variance uncertain by another hundredth.
        CHECK(std::abs(growth - (moved - places)) < 0.5);
        // The variance of an evenly covered disc of diameter c is c^2/16. Nine points of the lens have 0.8 % less, 36
        // have 2.7 % more, and their correlation with the places in the pixel adds or takes up to a tenth.
        CHECK(std::abs(growth / (circle * circle / 16.0) - 1.0) < 0.12);
        // Nothing lies farther out than the circle.
        const double radius = 0.06 * perUnit / std::sqrt(1.0 - 0.06 * 0.06) + 0.5 * circle + 0.75;
        for (int y = 0; y < kSize.height; ++y)
            for (int x = 0; x < kSize.width; ++x)
                if (std::hypot(x + 0.5 - 60.5, y + 0.5 - 37.5) > radius) REQUIRE(linearOf(image, x, y) == 0.0);
    }
}

TEST_CASE("What lies in focus beside the picture's middle stays there through every point of the lens", "[blur]") {
    render::Camera camera;
    camera.eye = {1.0F, 2.0F, 9.0F};
    camera.target = {0.5F, 0.3F, -1.0F};
    camera.aperture = 0.8F;
    camera.focus = 6.0F;
    const render::CameraFrame middle = render::cameraFrame(camera, kSize);
    for (int k = 0; k < 9; ++k) {
        const render::Camera seen = render::throughLens(camera, render::pixelSample(k, 3).onLens);
        const render::CameraFrame frame = render::cameraFrame(seen, kSize);
        CHECK(glm::distance(frame.forward, middle.forward) < 1e-6F);
        CHECK(std::abs(glm::distance(seen.eye, camera.eye) - 0.4F * glm::length(render::pixelSample(k, 3).onLens)) <
              1e-5F);
        for (const glm::vec2 at : {glm::vec2(0.0F), glm::vec2(1.5F, -0.7F), glm::vec2(-2.0F, 1.0F)}) {
            const glm::vec3 point = camera.eye + 6.0F * middle.forward + at.x * middle.right + at.y * middle.up;
            const glm::vec3 view = frame.toView(point);
            CHECK(glm::distance(glm::vec2(view) / view.z - frame.middle, at / 6.0F) < 1e-6F);
        }
    }
}

TEST_CASE("Blurred pictures are those of the oracle", "[blur][long]") {
    const By by = GENERATE(from_range(renderers()));
    const View view = movingCloud(60, 3);
    const render::Image image = drawn(by, view, kSize, Quality::final);
    // The oracle sees the same nine moments, each through 16 points of the lens.
    const Difference difference = compare(image, blurredByOracle(view, 4), 40);
    const Difference ofSharp = [&] {
        View sharp = view;
        sharp.shutter.reset();
        sharp.camera.aperture = 0.0F;
        return compare(image, drawn(by, sharp, kSize, Quality::final), 40);
    }();
    CAPTURE(by, difference, ofSharp);
    CHECK(difference.mean < 2.5);
    CHECK(difference.share < 0.01);
    CHECK(ofSharp.mean > 2.0 * difference.mean);
}

TEST_CASE("More samples come nearer to the limit of many moments and points of the lens", "[blur][long]") {
    const View dense = movingCloud(25, 8);
    const render::Image limit = blurredByOracle(dense, 2);
    std::vector<double> errors;
    for (const int perAxis : {2, 3, 6})
        errors.push_back(compare(drawn(movingCloud(25, perAxis), kSize, Quality::final), limit, 2).mean);
    CAPTURE(errors[0], errors[1], errors[2]);
    CHECK(errors[1] < errors[0]);
    CHECK(errors[2] < 0.6 * errors[1]);
}

TEST_CASE("A still scene before an open shutter has the bits of one without", "[blur]") {
    const By by = GENERATE(from_range(renderers()));
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        View view = cloudWithObstacles(100);
        view.style = style;
        view.light.shadows = true;
        view.ambient.occlusion = 0.8F;
        view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
        const render::Image without = drawn(by, view, kSize, Quality::final);
        openShutter(view, 1.0F, std::vector<glm::vec3>(view.particles.size(), glm::vec3(0.0F)));
        CHECK(drawn(by, view, kSize, Quality::final).rgb == without.rgb);
    }
}

TEST_CASE("Pictures of less than final quality have no blur", "[blur]") {
    const By by = GENERATE(from_range(renderers()));
    View view = movingCloud(60, 3);
    View sharp = view;
    sharp.shutter.reset();
    sharp.camera.aperture = 0.0F;
    for (const Quality quality : {Quality::draft, Quality::normal})
        CHECK(drawn(by, view, kSize, quality).rgb == drawn(by, sharp, kSize, quality).rgb);
}

TEST_CASE("Blurred pictures have the same bits for any number of threads, and leave nothing behind", "[blur]") {
    View balls = movingCloud(60, 2);
    balls.style = render::Style::metaballs;
    const View sharp = cloudWithObstacles(60);
    constexpr render::PictureSize kFewPixels{61, 38};
    const render::Image ofSharp = drawn(sharp, kFewPixels, Quality::final);
    for (const View& view : {movingCloud(60, 2), balls}) {
        const render::Image first = drawn(view, kFewPixels, Quality::final);
        for (const std::size_t threads : {1U, 2U}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            render::Renderer renderer(kFewPixels, Quality::final);
            CHECK(renderer.draw(view).rgb == first.rgb);
            CHECK(renderer.draw(sharp).rgb == ofSharp.rgb);
            CHECK(renderer.draw(view).rgb == first.rgb);
        }
    }
}

TEST_CASE("OpenGL blurs as the CPU does", "[blur][opengl][long]") {
    if (renderers().size() < 2) {
        SUCCEED("this build has no OpenGL");
        return;
    }
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        View view = movingCloud(60, 4);
        view.style = style;
        view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
        for (render::Moment& moment : view.shutter->moments) moment.edges = view.edges;
        const Difference difference =
            compare(drawn(By::openGl, view, kSize, Quality::final), drawn(By::cpu, view, kSize, Quality::final), 12);
        CAPTURE(static_cast<int>(style), difference);
        // As without blur: about ten pixels of outlines and of the line.
        CHECK(difference.share <= 10.0 / kPixels);
        CHECK(difference.mean < 0.2);
    }
}

TEST_CASE("Depth, normals and ids show the view's own moment from the middle of the lens", "[blur][layers]") {
    View view = movingCloud(60, 3);
    view.particleIds.resize(view.particles.size());
    for (std::size_t k = 0; k < view.particleIds.size(); ++k) view.particleIds[k] = static_cast<std::uint32_t>(k);
    View sharp = view;
    sharp.shutter.reset();
    sharp.camera.aperture = 0.0F;
    const int perAxis = GENERATE(3, 4);
    sharp.samplesPerAxis = 3;
    if (perAxis == 4) {
        view.shutter.reset();
        view.samplesPerAxis = 4;
    }
    Layers blurred;
    Layers own;
    render::Renderer renderer(kSize, Quality::final);
    renderer.draw(sharp, {.image = true, .color = true, .points = true, .ids = true}, own);
    renderer.draw(view, {.image = true, .color = true, .points = true, .ids = true}, blurred);
    CHECK(blurred.ids == own.ids);
    CHECK(std::ranges::equal(blurred.points, own.points,
                             [](const auto& a, const auto& b) { return a.depth == b.depth && a.normal == b.normal; }));
    CHECK(blurred.image.rgb != own.image.rgb);
    // Colors with alpha are blurred as the picture is: over the background they are the picture.
    double largest = 0.0;
    for (std::size_t pixel = 0; pixel < blurred.color.size(); ++pixel) {
        const auto x = static_cast<int>(pixel) % kSize.width;
        const auto y = static_cast<int>(pixel) / kSize.width;
        const glm::vec4& color = blurred.color[pixel];
        const glm::dvec3 behind =
            glm::mix(glm::dvec3(view.background.top), glm::dvec3(view.background.bottom), (y + 0.5) / kSize.height);
        const glm::dvec3 over = glm::dvec3(color) + (1.0 - double(color.a)) * behind;
        for (int channel = 0; channel < 3; ++channel)
            largest = std::max(
                largest, std::abs(encodedSteps(std::clamp(over[channel], 0.0, 1.0)) + oracle::ditherThreshold(x, y) -
                                  0.5 - blurred.image.rgb[3 * pixel + static_cast<std::size_t>(channel)]));
    }
    // As in layers_test.cpp: half a step of rounding, and the background of a sample at its own height.
    CHECK(largest <= 0.65);
}

TEST_CASE("A shutter needs a moment for each sample and a velocity for each particle", "[blur]") {
    View view = movingCloud(10, 3);
    view.shutter->moments.pop_back();
    CHECK_THROWS_AS(drawn(view, kSize, Quality::final), std::logic_error);
    view = movingCloud(10, 3);
    view.shutter->velocities.pop_back();
    CHECK_THROWS_AS(drawn(view, kSize, Quality::final), std::logic_error);
    view = movingCloud(10, 3);
    view.shutter->velocities.clear();
    CHECK_NOTHROW(drawn(view, kSize, Quality::final));
}
