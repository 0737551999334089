// The same view gives the same bytes with any number of threads, from any thread and in every run.
#include "tests/catch.h"

#include <thread>

#include <tbb/global_control.h>

#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{200, 117};

std::vector<render::View> views() {
    render::View spheres = cloudWithObstacles(300);
    spheres.light.shadows = true;
    spheres.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
    render::View balls = spheres;
    balls.style = render::Style::metaballs;
    render::View full = balls;
    full.light.softness = 0.7F;
    full.ambient.occlusion = 0.8F;
    full.surface = {0.04F, 8, 1.0F, 0.3F, 0.4F, 0.5F, 0.6F, 0.2F};
    full.exposure = 1.2F;
    full.field.skin = render::Skin::smooth;
    render::View fullSpheres = full;
    fullSpheres.style = render::Style::spheres;
    render::View meshes = cloudWithMeshes(100);
    meshes.light.shadows = true;
    meshes.light.softness = 0.4F;
    return {spheres, balls, full, fullSpheres, meshes};
}

}  // namespace

TEST_CASE("One and two threads, and run after run, give identical pixels") {
    for (const render::View& view : views()) {
        const render::Image first = drawn(view, kSize, Quality::normal);
        CHECK(first.rgb == drawn(view, kSize, Quality::normal).rgb);
        for (const std::size_t threads : {1U, 2U}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            CHECK(first.rgb == drawn(view, kSize, Quality::normal).rgb);
        }
    }
}

TEST_CASE("Frames may be drawn by one thread after another and do not affect each other") {
    const std::vector<render::View> both = views();
    render::Renderer renderer(kSize, Quality::normal);
    const render::Image spheres = renderer.draw(both[0]);
    render::Image balls;
    render::Image again;
    std::thread([&] { balls = renderer.draw(both[1]); }).join();
    std::thread([&] { again = renderer.draw(both[0]); }).join();
    CHECK(spheres.rgb == again.rgb);
    CHECK(balls.rgb == drawn(both[1], kSize, Quality::normal).rgb);
}
