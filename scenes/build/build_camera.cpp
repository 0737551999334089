// [camera], or the [[camera]] list that makes a path.
#include <fmt/format.h>

#include <numbers>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

/// Squared sine of the angle below which "up" cannot be told from the direction of view.
constexpr double kParallel = 1e-12;

void checkView(Section& section, BuildContext& context) {
    const auto forward = unitVector(section.vector("target") - section.vector("eye"));
    const auto up = unitVector(section.vector("up"));
    if (!forward) report(section, "target", "target is where eye is, must be another point", context);
    if (!up) report(section, "up", "up is [0, 0, 0], must not be zero", context);
    if (forward && up && engine::squaredLength(forward->cross(*up)) < kParallel)
        report(section, "up", "up lies along the direction of view, must point across it", context);
}

/// What only several cameras can have wrong: times, and two ways to draw depth, between which there is nothing.
void checkOrder(std::vector<Section>& sections, BuildContext& context) {
    const Section* before = nullptr;
    for (Section& section : sections) {
        if (!section.isGiven("time")) reportMissing(section, "time", context);
        if (before != nullptr && before->has("time") && section.has("time") &&
            section.number("time") <= before->number("time"))
            report(section, "time",
                   fmt::format("time is {}, must be after that of the camera before, {} (seconds)",
                               section.canonical("time"), before->canonical("time")),
                   context);
        if (before != nullptr && section.text("projection") != before->text("projection"))
            report(section, "projection",
                   fmt::format("projection is {}, must stay {} along the path", section.canonical("projection"),
                               before->canonical("projection")),
                   context);
        before = &section;
    }
}

CameraPlacement placementOf(const Section& section) {
    CameraPlacement camera;
    camera.eye = section.vector("eye");
    camera.target = section.vector("target");
    camera.up = section.vector("up");
    if (section.text("projection") == "orthographic") {
        camera.projection = render::Projection::orthographic;
        camera.halfHeight = section.number("half_height");
    } else {
        camera.verticalFov = section.number("fov") * std::numbers::pi / 180.0;
    }
    return camera;
}

}  // namespace

CameraPath buildCamera(std::vector<Section>& sections, BuildContext& context) {
    CameraPath path;
    for (Section& section : sections) checkView(section, context);
    if (sections.size() > 1) checkOrder(sections, context);
    for (const Section& section : sections) {
        if (!section.isSound()) return {{CameraKey{}}};
        path.keys.push_back({section.has("time") ? section.number("time") : 0.0, placementOf(section)});
    }
    return path;
}

}  // namespace scenes
