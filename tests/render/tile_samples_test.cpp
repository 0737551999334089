// Whole pictures with several samples per pixel: the same bits on every instruction set, and edges of boxes.
#include "tests/catch.h"

#include <hwy/highway.h>

#include "render/picture/camera_frame.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{201, 122};  // no whole number of tiles

/// A view with everything that kernels compute: obstacles, lines, soft shadows, sky visibility, reflections.
render::View fullView(render::Style style, render::Projection projection) {
    render::View view = cloudWithObstacles(250);
    view.style = style;
    view.camera.projection = projection;
    view.camera.halfHeight = 2.0F;
    view.light.shadows = true;
    view.light.softness = 0.8F;
    view.ambient.occlusion = 0.8F;
    view.surface.translucency = 0.4F;
    view.surface.reflection = 0.5F;
    view.edges.push_back({{-2.0F, 0.5F, -2.0F}, {2.0F, 0.5F, 2.0F}, glm::vec3(1.0F, 0.9F, 0.0F), 1.5F});
    return view;
}

/// Calls visit(name) with each instruction set that this machine has, and then restores the best one.
template <typename Visit>
void onEachInstructionSet(const Visit& visit) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        visit(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

TEST_CASE("Every instruction set draws the same pictures") {
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
            for (const float softness : {0.0F, 0.8F}) {
                render::View view = fullView(style, projection);
                view.light.softness = softness;
                std::vector<std::uint8_t> first;
                onEachInstructionSet([&](const char* name) {
                    CAPTURE(name, int(style), int(projection), softness);
                    const render::Image image = drawn(view, kSize, Quality::normal);
                    if (first.empty()) first = image.rgb;
                    CHECK((image.rgb == first));
                });
            }
        }
    }
}

TEST_CASE("The faces of a box are shaded apart where they meet within a pixel") {
    render::View view = cloudWithObstacles(0);
    view.boxObstacles.front() = {{-1.0F, 0.01F, -1.0F}, {1.0F, 1.6F, 1.0F}, {0.9F, 0.9F, 0.9F}};
    view.sphereObstacles.clear();
    view.light.shadows = false;
    // Four samples per pixel against sixteen. If a pixel were shaded once for the whole box, its edges would stay as
    // rough as with one sample.
    const render::Image exact = fromOracle(view, kSize, 4);
    const double draft = compare(drawn(view, kSize, Quality::draft), exact, 0).mean;
    const double normal = compare(drawn(view, kSize, Quality::normal), exact, 0).mean;
    CAPTURE(draft, normal);
    CHECK(normal < 0.6 * draft);
}

TEST_CASE("A camera inside a box sees its nearest face") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        render::View view = cloudWithObstacles(0);
        view.camera.projection = projection;
        view.camera.halfHeight = 0.3F;
        view.camera.eye = {1.2F, 0.4F, 1.95F};
        view.camera.target = {1.3F, 0.3F, 0.0F};
        const Difference difference = compare(drawn(view, kSize, Quality::draft), fromOracle(view, kSize, 1), 1);
        CAPTURE(int(projection));
        INFO(difference);
        CHECK(difference.share <= 4.0 / (201.0 * 122.0));  // on a border between nearest faces
    }
}
