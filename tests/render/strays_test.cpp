// Particles that are not in the picture and cannot shade what is in it do not change it, however far away they are.
#include "tests/catch.h"

#include <string>
#include <vector>

#include "render/picture/camera_frame.h"
#include "render/prepare/cells/strays.h"
#include "tests/render/pictures.h"

namespace {

constexpr render::PictureSize kSize{160, 90};

/// The cloud with every term of the shading model that depends on other particles.
render::View shadedCloud(render::Style style) {
    render::View view = pictures::cloudWithObstacles(150);
    view.style = style;
    view.light.shadows = true;
    view.light.softness = 0.5F;
    view.ambient.occlusion = 0.8F;
    view.surface.translucency = 0.5F;
    view.surface.absorption = 0.5F;
    return view;
}

render::View with(render::View view, const render::Sphere& particle) {
    view.particles.push_back(particle);
    return view;
}

/// Number of strays of a view.
std::size_t strayCount(const render::View& view) {
    const auto near = render::withoutStrays(view, render::cameraFrame(view.camera, kSize));
    return near ? view.particles.size() - near->particles.size() : 0;
}

}  // namespace

TEST_CASE("a particle that nobody sees does not change the picture") {
    // Behind the camera, beside it, above the picture, far below the ground, and over the horizon at the side.
    const std::vector<glm::vec3> directions = {
        {0.3F, 0.2F, 0.9F}, {1.0F, 0.0F, 0.0F}, {-0.3F, 0.9F, -0.3F}, {0.0F, -1.0F, 0.1F}, {-0.9F, 0.0F, -0.4F}};
    for (const auto quality : {render::Quality::draft, render::Quality::final}) {
        render::Renderer renderer(kSize, quality);
        for (const auto style : {render::Style::spheres, render::Style::metaballs}) {
            for (const auto skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic}) {
                render::View view = shadedCloud(style);
                view.field.skin = skin;
                const render::Image expected = renderer.draw(view);
                for (const float distance : {100.0F, 3e3F, 1e7F}) {
                    render::View strewn = view;
                    for (const glm::vec3 direction : directions)
                        strewn.particles.push_back({distance * glm::normalize(direction), 0.1F, glm::vec3(0.5F)});
                    const render::Image image = renderer.draw(strewn);
                    INFO("style " << static_cast<int>(style) << ", skin " << static_cast<int>(skin) << ", strays at "
                                  << distance << " m: " << pictures::compare(image, expected, 0));
                    CHECK((image.rgb == expected.rgb));
                }
                if (style == render::Style::spheres) break;
            }
        }
    }
}

TEST_CASE("a large particle or obstacle that nobody sees does not change the picture") {
    for (const auto style : {render::Style::spheres, render::Style::metaballs}) {
        const render::View view = shadedCloud(style);
        const render::Image expected = pictures::drawn(view, kSize, render::Quality::normal);
        render::View strewn = with(view, {{1e5F, -3e4F, 2e4F}, 1e3F, glm::vec3(0.5F)});
        strewn.sphereObstacles.push_back({{-1e6F, -1e5F, 1e5F}, 3e3F, glm::vec3(0.5F)});
        const render::Image image = pictures::drawn(strewn, kSize, render::Quality::normal);
        INFO(pictures::compare(image, expected, 0));
        CHECK((image.rgb == expected.rgb));
    }
}

TEST_CASE("what is seen, near, or between the picture and the light is no stray") {
    const render::View view = shadedCloud(render::Style::spheres);
    CHECK(strayCount(view) == 0);
    const auto isStray = [&](glm::vec3 center) { return strayCount(with(view, {center, 0.1F, {}})) == 1; };
    const glm::vec3 toLight = glm::normalize(view.light.toLight);
    const glm::vec3 forward = glm::normalize(view.camera.target - view.camera.eye);
    CHECK(!isStray({0.0F, 0.9F, 6.0F}));                     // beside the camera
    CHECK(!isStray(view.camera.eye + 500.0F * forward));     // far ahead
    CHECK(!isStray(view.camera.target + 100.0F * toLight));  // shades the cloud
    CHECK(isStray(view.camera.target - 100.0F * toLight));   // on the other side, outside of the picture
    CHECK(isStray(view.camera.eye - 100.0F * forward));
    // It shades the ground or an obstacle at (x, 0, z), outside of the picture or in it.
    CHECK(isStray(glm::vec3(50.0F, 0.0F, 50.0F) + 100.0F * toLight));
    CHECK(!isStray(glm::vec3(0.5F, 0.0F, 1.0F) + 100.0F * toLight));
    // A shadow from farther away does not count.
    CHECK(isStray(view.camera.target + 3000.0F * toLight));
}

TEST_CASE("a stray's shadow counts where it falls on a box without a ground") {
    render::View view = shadedCloud(render::Style::spheres);
    view.ground.reset();
    view.boxObstacles.push_back({{-40.0F, -1.0F, -40.0F}, {40.0F, 0.0F, 40.0F}, glm::vec3(0.5F)});
    const glm::vec3 toLight = glm::normalize(view.light.toLight);
    const auto isStray = [&](glm::vec3 center) { return strayCount(with(view, {center, 0.1F, {}})) == 1; };
    CHECK(!isStray(glm::vec3(0.5F, 0.0F, 1.0F) + 100.0F * toLight));
    CHECK(isStray(glm::vec3(38.0F, 0.0F, 38.0F) + 100.0F * toLight));  // on the box behind the camera
}

TEST_CASE("a stray's shadow counts on each of several boxes, and not where it falls between them") {
    render::View view = shadedCloud(render::Style::spheres);
    view.ground.reset();
    view.boxObstacles.clear();
    for (const float x : {-20.0F, 20.0F})
        view.boxObstacles.push_back({{x - 0.5F, -1.5F, -31.0F}, {x + 0.5F, -1.0F, -30.0F}, glm::vec3(0.5F)});
    view.camera.verticalFov = 1.2F;
    const glm::vec3 toLight = glm::normalize(view.light.toLight);
    const auto isStray = [&](float x) {
        // Large enough for its shadow to be as wide as a pixel there.
        return strayCount(with(view, {glm::vec3(x, -1.2F, -30.5F) + 150.0F * toLight, 1.0F, {}})) == 1;
    };
    CHECK(!isStray(-20.0F));
    CHECK(!isStray(20.0F));
    CHECK(isStray(0.0F));   // between them
    CHECK(isStray(40.0F));  // beside both
}

TEST_CASE("without light and without particles there are no strays") {
    render::View view = shadedCloud(render::Style::spheres);
    view.particles.clear();
    CHECK(strayCount(view) == 0);
    // Nothing is seen: nothing is removed.
    view.particles = {{{0.0F, 0.0F, 1e6F}, 0.1F, {}}, {{0.0F, 0.0F, 2e6F}, 0.1F, {}}};
    CHECK(strayCount(view) == 0);
}
