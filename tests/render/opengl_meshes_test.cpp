// Triangle meshes as obstacles drawn by OpenGL, which the CPU's pictures and the oracle judge here.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <vector>

#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

/// OpenGL's picture against the CPU's.
Difference fromCpu(const render::View& view, Quality quality, int limit) {
    return compare(drawn(By::openGl, view, kSize, quality), drawn(By::cpu, view, kSize, quality), limit);
}

}  // namespace

TEST_CASE("OpenGL draws meshes among particles as the oracle does", "[opengl][meshes]") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        for (const Style style : {Style::spheres, Style::metaballs}) {
            render::View view = cloudWithMeshes(60);
            view.style = style;
            view.camera.projection = projection;
            view.camera.halfHeight = 2.0F;
            const Difference difference = differenceFromOracle(By::openGl, view, kSize, 2);
            INFO("projection " << int(projection) << ", style " << int(style) << ": " << difference);
            // Pixels on outlines, which OpenGL rounds to 1/256 of a pixel; metaballs are cast at every second pixel.
            CHECK(difference.share <= (style == Style::spheres ? 20.0 : 60.0) / kPixels);
        }
    }
}

TEST_CASE("OpenGL antialiases and shadows meshes as the CPU does", "[opengl][meshes][long]") {
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
        for (const float softness : {0.0F, 1.0F}) {
            render::View view = cloudWithMeshes(60);
            view.light.shadows = true;
            view.light.softness = softness;
            view.ambient.occlusion = 0.7F;
            view.edges.push_back({{-1.5F, 0.0F, -1.5F}, {1.5F, 2.0F, 1.5F}});
            const Difference difference = fromCpu(view, quality, 24);
            INFO("quality " << int(quality) << ", softness " << softness << ": " << difference);
            // Chosen: about ten pixels of outlines and of the line.
            CHECK(difference.share <= 10.0 / kPixels);
            CHECK(difference.mean < 0.2);
            view.light.shadows = false;
            CHECK(fromCpu(view, quality, 24).share <= 10.0 / kPixels);
        }
    }
}

TEST_CASE("OpenGL clips meshes before the eye and shows their inner sides", "[opengl][meshes]") {
    render::View view = cloudWithMeshes(0);
    view.meshObstacles.push_back({meshSphere(4.0, 32), glm::mat3(1.0F), {0.0F, 1.0F, 0.0F}, {0.4F, 0.4F, 0.7F}});
    view.camera.eye = {0.9F, 1.05F, 1.9F};
    const Difference difference = fromCpu(view, Quality::draft, 8);
    INFO(difference);
    CHECK(difference.share <= 20.0 / kPixels);
}

TEST_CASE("OpenGL's layers have the depths and normals of meshes", "[opengl][meshes]") {
    const render::View view = cloudWithMeshes(0);
    const std::vector<render::VisiblePoint> byCpu = makeRenderer(By::cpu, kSize, Quality::draft)->visiblePoints(view);
    const std::vector<render::VisiblePoint> found = openGlRenderer(kSize, Quality::draft).visiblePoints(view);
    REQUIRE(found.size() == byCpu.size());
    int others = 0;
    for (std::size_t k = 0; k < found.size(); ++k)
        // Normals are kept in 16 bits a coordinate, and depths in single precision: both far below the limits.
        if (std::abs(found[k].depth - byCpu[k].depth) > 1e-3F * byCpu[k].depth ||
            distance(found[k].normal, byCpu[k].normal) > 1e-2F)
            ++others;
    INFO(others << " points differ");
    CHECK(others <= 20);  // outlines and edges
}

#endif
