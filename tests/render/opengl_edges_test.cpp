// Views that strain the renderer in OpenGL, which the CPU's pictures judge here: very many lines, long lists, pixels
// that see every particle.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <cmath>
#include <string>

#include "render/compare/compare.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{121, 75};

/// Both renderers' pictures, within the limits for them.
void requireAlike(const render::View& view, render::PictureSize size) {
    const render::Image byCpu = drawn(By::cpu, view, size, Quality::draft);
    const render::Image byOpenGl = drawn(By::openGl, view, size, Quality::draft);
    const render::Comparison comparison = render::compare(byOpenGl, byCpu, render::limitsOf("renderer"));
    for (const std::string& reason : comparison.reasons) UNSCOPED_INFO(reason);
    CHECK(comparison.passed());
}

}  // namespace

TEST_CASE("OpenGL draws thousands of lines as the CPU does", "[opengl]") {
    render::View view = cloud(20);
    for (int k = 0; k < 5000; ++k) {
        const float angle = 0.37F * static_cast<float>(k);
        const glm::vec3 around(2.0F * std::cos(angle), 0.0004F * static_cast<float>(k), 2.0F * std::sin(angle));
        view.edges.push_back(
            {around, glm::vec3(0.5F * around.z, around.y + 0.3F, 0.5F * around.x), glm::vec3(0.1F, 0.9F, 0.1F), 0.3F});
    }
    requireAlike(view, kSize);
    view.edges.resize(1);
    const render::Image one = drawn(By::openGl, view, kSize, Quality::draft);
    view.edges.assign(2000, view.edges[0]);  // all in the same tiles
    requireAlike(view, kSize);
    CHECK(compare(drawn(By::openGl, view, kSize, Quality::draft), one, 8).share > 0.001);  // many cover more than one
}

TEST_CASE("OpenGL draws particles that are in every tile", "[opengl]") {
    render::View view = cloud(0);
    for (int k = 0; k < 3000; ++k)
        view.particles.push_back({{0.001F * static_cast<float>(k % 50), 1.0F, 0.0F}, 6.0F, {0.2F, 0.4F, 0.6F}});
    for (const Style style : {Style::spheres, Style::metaballs}) {
        view.style = style;
        if (style == Style::metaballs) view.particles.resize(300);
        requireAlike(view, {33, 17});
        // The eye is inside of all of them. Metaballs begin where the number does not say that there are none.
        for (const render::VisiblePoint& point : openGlRenderer({33, 17}, Quality::draft).visiblePoints(view)) {
            REQUIRE(point.depth >= 0.0F);
            REQUIRE(point.depth < 1e-20F);
        }
    }
}

#endif
