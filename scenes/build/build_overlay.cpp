// [overlay].
#include <fmt/format.h>

#include <cmath>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

/// The share of the picture's width that a scale bar takes at a camera's target.
double widthShare(double length, const CameraPlacement& camera, const Section& look) {
    const std::vector<double>& size = look.numbers("size");
    const double halfHeight =
        camera.projection == render::Projection::orthographic
            ? camera.halfHeight
            : std::tan(0.5 * camera.verticalFov) * std::sqrt(engine::squaredLength(camera.target - camera.eye));
    return length / (2.0 * halfHeight) * size[1] / size[0];
}

void checkScaleBar(Section& section, const Section& look, const CameraPath& camera, BuildContext& context) {
    constexpr double kWidest = 0.8;  // leaves room for margins at any size of the picture
    for (const CameraKey& key : camera.keys) {
        const double share = widthShare(section.number("scale_bar"), key.placement, look);
        if (share <= kWidest) continue;
        report(section, "scale_bar",
               fmt::format("scale_bar is {}, {:.2g} of the picture's width at the camera's target, must be at most {} "
                           "of it (meters)",
                           section.canonical("scale_bar"), share, kWidest),
               context);
        return;
    }
}

double luminance(const Vec3& linear) {
    return linear.dot(Vec3(0.2126, 0.7152, 0.0722));
}

/// Dark on a light background, light on a dark one.
Vec3 contrastingInk(const Section& look) {
    constexpr double kMiddleGray = 0.18;  // as far from black as from white, to the eye
    const double background =
        0.5 * (luminance(look.vector("background_top")) + luminance(look.vector("background_bottom")));
    return background > kMiddleGray ? Vec3(0.01, 0.01, 0.01) : Vec3(0.93, 0.93, 0.93);
}

}  // namespace

Overlay buildOverlay(Section& section, const Section& look, const CameraPath& camera, BuildContext& context) {
    const bool byMaterial = look.text("color_by") == "material";
    if (look.isSound() && byMaterial && section.flag("color_bar"))
        report(section, "color_bar",
               "color_bar is true, but colors by material have no scale; it needs look.color_by \"speed\" or \"age\"",
               context);
    if (section.number("scale_bar") > 0.0) checkScaleBar(section, look, camera, context);
    if (!byMaterial) section.deriveText("color_label", look.text("color_by"));
    section.deriveVector("ink", contrastingInk(look));
    Overlay overlay;
    if (!section.isSound()) return overlay;
    overlay.time = section.flag("time");
    overlay.scaleBar = section.number("scale_bar");
    overlay.colorBar = section.flag("color_bar");
    if (section.has("color_label")) overlay.colorLabel = section.text("color_label");
    overlay.ink = section.vector("ink");
    overlay.size = section.number("size");
    return overlay;
}

}  // namespace scenes
