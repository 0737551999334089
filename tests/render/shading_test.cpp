// Every term of the shading model, soft shadows and the smooth skin against the oracle, one at a time and together.
#include "tests/catch.h"

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include <tbb/global_control.h>

#include "render/prepare/lighting/ambient_occlusion.h"
#include "render/prepare/skin/skin.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

struct Term {
    std::string name;
    std::function<void(render::View&)> add;
    bool dependsOnSky = false;  ///< on the sky visibility, which spheres and metaballs have each in their own way
};

std::vector<Term> terms() {
    return {{"occlusion", [](render::View& v) { v.ambient.occlusion = 0.9F; }, true},
            {"roughness", [](render::View& v) { v.surface.roughness = 0.8F; }},
            {"reflection", [](render::View& v) { v.surface.reflection = 1.5F; }, true},
            {"metal", [](render::View& v) { v.surface.metal = 0.7F; }},
            {"translucency", [](render::View& v) { v.surface.translucency = 0.6F; }, true},
            {"absorption", [](render::View& v) { v.surface.absorption = 0.8F; }, true},
            {"glow", [](render::View& v) { v.surface.glow = 0.5F; }},
            {"rim light",
             [](render::View& v) {
                 v.light.rim = {0.9F, 0.7F, 0.4F};
             }},
            {"exposure", [](render::View& v) { v.exposure = 1.6F; }}};
}

/// So many particles that some are occluded from the sky, with obstacles.
render::View denseCloud(Style style) {
    render::View view = cloudWithObstacles(250);
    view.style = style;
    view.surroundings = {{0.9F, 0.8F, 1.0F}, {0.6F, 0.6F, 0.5F}, {0.2F, 0.3F, 0.1F}};
    return view;
}

}  // namespace

TEST_CASE("Each term of the shading is the oracle's, and changes the picture", "[long]") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Style style : {Style::spheres, Style::metaballs}) {
        const render::View plain = denseCloud(style);
        const render::Image without = drawn(by, plain, kSize, Quality::draft);
        for (const Term& term : terms()) {
            // Shaders are compiled for each look; the terms of the others are the same code for both styles.
            if (by == By::openGl && style == Style::metaballs && !term.dependsOnSky) continue;
            render::View view = plain;
            term.add(view);
            const Difference difference = differenceFromOracle(by, view, kSize, 2);
            INFO(term.name << ", style " << int(style) << ": " << difference);
            // 2 steps: packed normals and sky visibilities; 10 pixels: outlines, where single precision may decide
            // otherwise.
            CHECK(difference.share <= 10.0 / kPixels);
            CHECK(difference.mean < 0.05);  // rounding
            CHECK(compare(without, drawn(by, view, kSize, Quality::draft), 2).share > 0.02);
        }
    }
}

TEST_CASE("All terms together are the oracle's, in parallel projection too") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Style style : {Style::spheres, Style::metaballs}) {
        render::View view = denseCloud(style);
        for (const Term& term : terms()) term.add(view);
        view.camera.projection = render::Projection::orthographic;
        view.camera.halfHeight = 2.0F;
        const Difference difference = differenceFromOracle(by, view, kSize, 3);
        INFO("style " << int(style) << ": " << difference);
        CHECK(difference.share <= 15.0 / kPixels);  // 3 steps: packed inputs of all terms; 15 pixels on outlines
    }
}

TEST_CASE("The shadow of the outermost spheres is soft to its end") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    // No other sphere casts a shadow, so the soft edge reaches beyond the bounds of all spheres in the light's view.
    render::View view = cloud(1);
    view.style = Style::spheres;
    view.particles.front() = {{0.0F, 1.2F, 0.0F}, 0.5F, {0.9F, 0.5F, 0.2F}};
    view.light.shadows = true;
    view.light.softness = 1.0F;
    const Difference difference = differenceFromOracle(by, view, kSize, 2);
    INFO(difference);
    CHECK(difference.share <= 2.0 / kPixels);  // pixels on outlines, where single precision may decide otherwise
}

TEST_CASE("Soft shadows of spheres and boxes are the oracle's") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloudWithObstacles(120);
    view.light.shadows = true;
    for (const float softness : {0.3F, 1.0F}) {
        view.light.softness = softness;
        const Difference difference = differenceFromOracle(by, view, kSize, 2);
        INFO("softness " << softness << ": " << difference);
        // Where an occluder touches the surface, the edge is a pixel wide here and sharp in the oracle; counted once:
        // 0.0022.
        CHECK(difference.share < 0.005);
        CHECK(difference.mean < 0.05);  // rounding, and half of the contrast in those pixels
    }
    render::View sharp = view;
    sharp.light.softness = 0.0F;
    CHECK(compare(drawn(by, view, kSize, Quality::draft), drawn(by, sharp, kSize, Quality::draft), 2).share > 0.03);
}

TEST_CASE("Soft shadows of metaballs are the oracle's up to the depth map's texels") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(150);
    view.style = Style::metaballs;
    view.light.shadows = true;
    view.light.softness = 1.0F;
    const Difference difference = differenceFromOracle(by, view, kSize, 12);
    INFO(difference);
    // The oracle casts nine rays across a soft edge, so that single samples are a ninth of the light (some 14 steps)
    // off.
    CHECK(difference.share < 0.03);  // counted once: 0.021
    CHECK(difference.mean < 0.8);    // counted once: 0.66
    render::View sharp = view;
    sharp.light.softness = 0.0F;
    CHECK(compare(drawn(by, view, kSize, Quality::draft), drawn(by, sharp, kSize, Quality::draft), 12).share > 0.02);
}

TEST_CASE("Better quality is nearer to the exact picture with all terms", "[long]") {
    render::View view = cloud(150);
    view.style = Style::metaballs;
    view.light.shadows = true;
    view.light.softness = 1.0F;
    for (const Term& term : terms()) term.add(view);
    const render::Image exact = fromOracle(view, kSize, 4);
    const double normal = compare(drawn(view, kSize, Quality::normal), exact, 0).mean;
    const double final = compare(drawn(view, kSize, Quality::final), exact, 0).mean;
    CAPTURE(normal, final);
    CHECK(normal < 1.5);  // steps of 1/255 on average, chosen
    CHECK(final < 0.8 * normal);
}

TEST_CASE("Tiles of open ground and of background leave nothing out") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    // The same surfaces with two spheres far away below the ground, which shade nothing but whose bounds are
    // everywhere: no tile counts as open ground any more.
    render::View view = denseCloud(Style::spheres);
    view.light.shadows = true;
    view.light.softness = 0.5F;
    view.ambient.occlusion = 0.8F;
    const render::Image plain = drawn(by, view, {400, 225}, Quality::normal);
    view.sphereObstacles.push_back({{-300.0F, -400.0F, -300.0F}, 1.0F, {}});
    view.sphereObstacles.push_back({{300.0F, -400.0F, 300.0F}, 1.0F, {}});
    // Open ground is colored from one color of the whole ground, other ground point by point: few of the results differ
    // in their last bits, and few of these are rounded to different bytes.
    const render::Image pixelwise = drawn(by, view, {400, 225}, Quality::normal);
    CHECK(compare(pixelwise, plain, 1).share == 0.0);
    CHECK(compare(pixelwise, plain, 0).share < 1e-4);
}

TEST_CASE("A strength of zero leaves the picture as it was") {
    for (const Style style : {Style::spheres, Style::metaballs}) {
        render::View view = denseCloud(style);
        view.light.shadows = true;
        const render::Image before = drawn(view, kSize, Quality::normal);
        view.surroundings.top = {5.0F, 0.0F, 0.0F};  // no effect without reflection
        CHECK(drawn(view, kSize, Quality::normal).rgb == before.rgb);
    }
}

TEST_CASE("Sky visibility: a lone particle sees the sky, one in a block does not, one on top sees it upwards") {
    const auto openOf = [](const std::vector<render::Sphere>& particles, glm::vec3 place) {
        const std::vector<render::Sphere> there{{place, 0.1F, {}}};
        return render::particleSkyVisibility(there, render::skyVisibilityGrid(particles)).front();
    };
    // A particle's own volume, 0.52 of a cube, is spread and blurred to at most one cube beyond its own.
    for (const float value : openOf({{{0.3F, 1.0F, 0.2F}, 0.1F, {}}}, {0.3F, 1.0F, 0.2F})) CHECK(value > 0.8F);
    std::vector<render::Sphere> block;
    for (int k = 0; k < 12 * 12 * 12; ++k) block.push_back({0.2F * glm::vec3(k % 12, k / 12 % 12, k / 144), 0.1F, {}});
    for (const float value : openOf(block, {1.1F, 1.1F, 1.1F})) CHECK(value < 0.3F);
    const render::SkyVisibility top = openOf(block, {1.1F, 2.2F, 1.1F});
    CHECK(top[2] > 0.8F);
    CHECK(top[3] < 0.3F);
    CHECK(openOf(block, {50.0F, 1.0F, 1.0F}) == render::kUnoccluded);
    CHECK(openOf({}, {0.0F, 0.0F, 0.0F}) == render::kUnoccluded);
}

TEST_CASE("Sky visibility is the same in the memory of another scene's") {
    std::vector<render::Sphere> block;
    for (int k = 0; k < 12 * 12 * 12; ++k) block.push_back({0.2F * glm::vec3(k % 12, k / 12 % 12, k / 144), 0.1F, {}});
    const std::span all(block);
    for (const auto& [now, before] : {std::pair{all, all.first(7)}, std::pair{all.first(7), all}}) {
        const render::SkyVisibilityGrid fresh = render::skyVisibilityGrid(now);
        const render::SkyVisibilityGrid reused = render::skyVisibilityGrid(now, render::skyVisibilityGrid(before));
        CHECK(reused.cells == fresh.cells);
        CHECK(reused.origin == fresh.origin);
        CHECK(reused.values == fresh.values);
    }
    CHECK(render::skyVisibilityGrid({}, render::skyVisibilityGrid(block)).cells == glm::ivec3(0));
}

TEST_CASE("Sky visibility depends only a little on where the cubes lie") {
    std::vector<render::Sphere> block;
    for (int k = 0; k < 10 * 10 * 10; ++k) block.push_back({0.2F * glm::vec3(k % 10, k / 10 % 10, k / 100), 0.1F, {}});
    float least = 1.0F;
    float most = 0.0F;
    for (int shift = 0; shift < 20; ++shift) {
        std::vector<render::Sphere> moved = block;
        const glm::vec3 off(0.011F * static_cast<float>(shift), 0.007F * static_cast<float>(shift), 0.0F);
        for (render::Sphere& particle : moved) particle.center += off;
        const render::SkyVisibility open = render::particleSkyVisibility(moved, render::skyVisibilityGrid(moved))[905];
        least = std::min(least, open[0]);
        most = std::max(most, open[0]);
    }
    CAPTURE(least, most);
    CHECK(most - least < 0.1F);  // chosen: a tenth of the ambient light, while the block moves by the width of a cube
}

TEST_CASE("Thread counts change neither sky visibility nor skin") {
    render::View view = cloud(3000);
    view.style = Style::metaballs;
    view.field.skin = GENERATE(render::Skin::smooth, render::Skin::anisotropic);
    std::vector<render::SkinBall> first;
    std::vector<float> open;
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const std::vector<render::SkinBall> skin = render::skinOf(view);
        const std::vector<float> values = render::skyVisibilityGrid(view.particles).values[3];
        if (first.empty()) first = skin;
        if (open.empty()) open = values;
        CHECK(open == values);
        for (std::size_t k = 0; k < skin.size(); ++k) {
            REQUIRE(skin[k].center == first[k].center);
            REQUIRE(skin[k].weight == first[k].weight);
            REQUIRE(skin[k].reach == first[k].reach);
            REQUIRE(skin[k].spread == first[k].spread);
        }
    }
}

TEST_CASE("A smooth skin and an anisotropic one are the oracle's") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = denseCloud(Style::metaballs);
    view.field.skin = GENERATE(render::Skin::smooth, render::Skin::anisotropic);
    for (const float reach : {2.0F, 3.5F}) {
        view.field.reach = reach;
        const Difference difference = differenceFromOracle(by, view, kSize, 2);
        INFO("reach " << reach << ": " << difference);
        CHECK(difference.share <= 12.0 / kPixels);  // outlines; counted once: at most 11
    }
}

TEST_CASE("A smooth skin's balls are the sums over all particles in reach") {
    render::View view = cloud(0);
    view.style = Style::metaballs;
    view.field = {2.5F, render::Skin::smooth};
    for (const int count : {1, 2, 15, 16, 17, 33}) {
        view.particles.clear();
        for (int k = 0; k < count; ++k) {
            const glm::vec3 at(std::sin(12.9F * float(k)), std::sin(7.3F * float(k)), std::sin(3.1F * float(k)));
            view.particles.push_back({0.25F * at, 0.04F * float(1 + k % 4), {0.5F, 0.5F, 0.5F}});
        }
        view.particles.push_back({{0.05F, 0.0F, 0.0F}, 0.0F, {0.5F, 0.5F, 0.5F}});
        view.particles.push_back({{9.0F, 9.0F, 9.0F}, 0.2F, {0.5F, 0.5F, 0.5F}});
        const std::vector<render::SkinBall> skin = render::skinOf(view);
        for (std::size_t p = 0; p < view.particles.size(); ++p) {
            const render::Sphere& here = view.particles[p];
            if (here.radius == 0.0F) continue;
            const double reach = double(view.field.reach);
            const double radius = double(here.radius);
            double density = 0.0;
            glm::dvec3 weightedOffset(0.0);
            double end = reach * radius;
            for (const render::Sphere& other : view.particles) {
                if (other.radius == 0.0F) continue;
                const glm::dvec3 off = glm::dvec3(other.center) - glm::dvec3(here.center);
                const double size = double(other.radius);
                const double sum = radius + size;
                const double root = std::max(0.0, 1.0 - glm::dot(off, off) / std::pow(0.5 * reach * sum, 2.0));
                const double k = root * root * std::max(0.0, 1.0 - 9.0 * std::pow((radius - size) / sum, 2.0));
                density += k;
                weightedOffset += k * off;
                const double beyond = (reach - 1.0) * (1.0 + 2.0 * size / radius) * size;
                if (size < 0.5 * radius) end = std::min(end, std::max(radius + beyond, glm::length(off) - size));
            }
            const double steeper = (1.0 - 1.0 / (reach * reach)) / (1.0 - radius * radius / (end * end));
            const glm::dvec3 center = glm::dvec3(here.center) + double(render::kSkinPull) * weightedOffset / density;
            INFO("particle " << p << " of " << count);
            // Tolerance: some forty additions of numbers below 1 in single precision (6e-8 each).
            CHECK(glm::length(glm::dvec3(skin[p].center) - center) < 3e-6);
            CHECK(std::abs(double(skin[p].weight) - steeper * steeper * std::pow(density, -0.75)) < 3e-6);
            CHECK(std::abs(double(skin[p].reach) - end) < 3e-7);
        }
    }
}

TEST_CASE("In a smooth skin a lone ball keeps its place and radius, and a flat pile is flatter than the plain one") {
    render::View view = cloud(0);
    view.style = Style::metaballs;
    view.field = {3.2F, render::Skin::smooth};
    view.particles.push_back({{0.1F, 1.0F, 0.2F}, 0.3F, {0.5F, 0.5F, 0.5F}});
    CHECK(render::skinOf(view)[0].center == view.particles[0].center);
    CHECK(render::skinOf(view)[0].weight == 1.0F);
    CHECK(render::skinOf(view)[0].reach == 3.2F * 0.3F);

    view.particles.clear();
    for (int k = 0; k < 20 * 20 * 5; ++k) {
        const glm::vec3 shake(0.02F * std::sin(12.9F * float(k)), 0.03F * std::sin(7.3F * float(k)), 0.0F);
        view.particles.push_back(
            {0.18F * glm::vec3(k % 20 - 10, k / 400, k / 20 % 20 - 10) + shake, 0.1F, {0.5F, 0.5F, 0.5F}});
    }
    view.ground.reset();
    view.camera.eye = {0.0F, 6.0F, 0.01F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.camera.verticalFov = 0.25F;
    render::Renderer renderer(kSize, Quality::draft);
    const auto meanSlant = [&] {
        double sum = 0.0;
        for (const render::VisiblePoint& point : renderer.visiblePoints(view)) {
            REQUIRE(point.depth > 0.0F);
            sum += 1.0 - double(point.normal.y);
        }
        return sum / kPixels;
    };
    const double smooth = meanSlant();
    const double height = 6.0 - double(renderer.visiblePoints(view)[kSize.width * 37 + 60].depth);
    view.field.skin = render::Skin::plain;
    const double plain = meanSlant();
    CAPTURE(smooth, plain, height);
    CHECK(smooth < 0.85 * plain);  // both at the same reach; counted once: 0.74
    // The centers of the top layer lie at 0.72 m, the surface about a radius of 0.1 m above them (counted once: 0.75
    // radii).
    CHECK(height > 0.77);
    CHECK(height < 0.87);
}
