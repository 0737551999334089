// Makes cameras, look and overlay of a scene from its tables [camera], [look] and [overlay]. A list of [[camera]]
// tables is a path of the camera.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/build/builders.h"
#include "scenes/build/overlay_text.h"
#include "scenes/model/to_float.h"
#include "scenes/text/black_body.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Squared sine of the angle below which "up" counts as parallel to the direction of view.
constexpr double kParallel = 1e-12;

void checkCamera(Section& section, BuildContext& context) {
    const auto forward = unitVector(section.vector("target") - section.vector("eye"));
    const auto up = directionFrom(section, "up", context);
    if (!forward) report(section, "target", context, "target is where eye is, must be another point");
    if (forward && up && engine::squaredLength(forward->cross(*up)) < kParallel)
        report(section, "up", context, "up lies along the direction of view, must point across it");
}

/// Checks the cameras of a path together: each needs a time, and the projection must not change, because perspective
/// and orthographic projection cannot be interpolated.
void checkPath(std::vector<Section>& sections, BuildContext& context) {
    const Section* previous = nullptr;
    for (Section& section : sections) {
        if (!section.isGiven("time")) reportMissing(section, "time", context);
        if (previous != nullptr && section.string("projection") != previous->string("projection"))
            report(section, "projection", context, "projection is {}, must stay {} along the path",
                   section.canonical("projection"), previous->canonical("projection"));
        if (previous != nullptr && section.integer("samples") != previous->integer("samples"))
            report(section, "samples", context, "samples is {}, must stay {} along the path",
                   section.canonical("samples"), previous->canonical("samples"));
        previous = &section;
    }
}

/// Checks the keys of the lens and the samples of a camera.
void checkLens(Section& section, BuildContext& context) {
    const int root = samplesPerAxis(section);
    if (root * root != section.integer("samples"))
        report(section, "samples", context, "samples is {}, must be a square number, such as {} or {}",
               section.canonical("samples"), root * root, (root + 1) * (root + 1));
    if (section.isGiven("focus") && section.has("aperture") && section.number("aperture") == 0.0)
        context.warnings.add(section.position("focus"), "focus has no effect without an aperture above 0");
}

CameraPlacement placementFrom(const Section& section) {
    CameraPlacement camera;
    camera.eye = section.vector("eye");
    camera.target = section.vector("target");
    camera.up = section.vector("up");
    if (section.string("projection") == "orthographic") {
        camera.projection = render::Projection::orthographic;
        camera.halfHeight = section.number("half_height");
    } else {
        camera.verticalFov = section.number("fov") * std::numbers::pi / 180.0;
        camera.aperture = section.number("aperture");
        if (section.has("focus")) camera.focus = section.number("focus");
    }
    camera.shutter = section.number("shutter");
    return camera;
}

/// The color map of a black body is made for temperatures at which there is some light.
void checkBlackBody(Section& section, BuildContext& context) {
    constexpr double kLowestEnd = 300.0;  // K; chosen: far below any visible light, far above where it is 0 in double
    if (!section.has("color_map") || section.string("color_map") != "black-body") return;
    if (section.string("color_by") != "temperature")
        report(section, "color_map", context, "color_map \"black-body\" is for color_by \"temperature\"");
    if (section.isGiven("color_range") && section.numbers("color_range")[1] < kLowestEnd)
        report(section, "color_range", context,
               "color_range ends at {} K, must reach {:g} K for color_map \"black-body\"",
               section.numbers("color_range")[1], kLowestEnd);
}

void readColors(Section& section, const BuildContext& context, Look& look) {
    const std::string& colorBy = section.string("color_by");
    look.colorBy = colorBy == "speed"         ? ColorBy::speed
                   : colorBy == "age"         ? ColorBy::age
                   : colorBy == "temperature" ? ColorBy::temperature
                                              : ColorBy::material;
    if (look.colorBy == ColorBy::material) return;
    look.isRampOfLight = section.has("color_map") && section.string("color_map") == "black-body";
    // The speed of the last color, 5 m/s, is chosen: about the speed of a fall from 1.3 m. The temperatures are those
    // of liquid water, and those between the first red that one sees in the dark and liquid steel or basalt.
    const std::vector<double> range = look.colorBy == ColorBy::speed         ? std::vector{0.0, 5.0}
                                      : look.isRampOfLight                   ? std::vector{800.0, 1500.0}
                                      : look.colorBy == ColorBy::temperature ? std::vector{273.15, 373.15}
                                                                             : std::vector{0.0, context.duration};
    section.derive("color_range", TypedValue::ofNumbers(range));
    look.rampLow = section.numbers("color_range")[0];
    look.rampHigh = section.numbers("color_range")[1];
    look.ramp = look.isRampOfLight         ? blackBodyRamp(look.rampLow, look.rampHigh)
                : section.has("color_map") ? colorMap(section.string("color_map"))
                                           : section.vectors("colors");
}

render::Skin skinNamed(std::string_view name) {
    if (name == "anisotropic") return render::Skin::anisotropic;
    return name == "smooth" ? render::Skin::smooth : render::Skin::plain;
}

/// Reads the keys of [look] that all frames share: lights, background, ground and the surface of the particles.
void readView(const Section& section, render::View& view) {
    const auto number = [&](std::string_view name) { return toFloat(section.number(name)); };
    const auto color = [&](std::string_view name) { return toFloat(section.vector(name)); };
    view.light.color = color("light_color");
    view.light.rim = color("rim_light");
    view.light.shadows = section.boolean("shadows");
    view.light.softness = number("shadow_softness");
    view.ambient = {color("ambient_sky"), color("ambient_ground"), number("occlusion")};
    view.surroundings = {color("mirror_top"), color("mirror_horizon"), color("mirror_bottom")};
    view.exposure = number("exposure");
    view.background = {color("background_top"), color("background_bottom")};
    if (section.boolean("ground"))
        view.ground = render::Ground{.color = color("ground_color"), .fadeDistance = number("ground_fade")};
    view.style = section.string("style") == "metaballs" ? render::Style::metaballs : render::Style::spheres;
    view.field.reach = number("metaball_reach");
    view.field.skin = skinNamed(section.string("skin"));
    view.surface.specular = number("specular");
    view.surface.glossExponent = static_cast<int>(section.integer("gloss"));
    view.surface.reflection = number("reflection");
    view.surface.metal = number("metal");
    view.surface.roughness = number("roughness");
    view.surface.translucency = number("translucency");
    view.surface.absorption = number("absorption");
    view.surface.glow = number("glow");
    view.surface.medium = mediumFrom(section);
}

/// Length of a scale bar at a camera's target, as a share of the picture's width.
double widthShare(double length, const CameraPlacement& camera, const Section& look) {
    const std::vector<double>& size = look.numbers("size");
    return length / (2.0 * halfHeightAtTarget(camera)) * size[1] / size[0];
}

void checkScaleBar(Section& section, const Section& look, const CameraPath& camera, BuildContext& context) {
    constexpr double kMaxShare = 0.8;  // share of the picture's width; chosen: leaves room for margins at any size
    for (const CameraKey& key : camera) {
        const double share = widthShare(section.number("scale_bar"), key.placement, look);
        if (share <= kMaxShare) continue;
        report(section, "scale_bar", context,
               "scale_bar is {}, {:.2g} of the picture's width at the camera's target, must be at most {} "
               "of it (meters)",
               section.canonical("scale_bar"), share, kMaxShare);
        return;
    }
}

double luminance(const Vec3& linear) {
    return linear.dot(Vec3(0.2126, 0.7152, 0.0722));
}

/// Color of the text of an overlay, linear RGB: dark on a light background, light on a dark one.
Vec3 contrastingInk(const Section& look) {
    constexpr double kMiddleGray = 0.18;  // linear light that looks half as bright as white
    const double background =
        0.5 * (luminance(look.vector("background_top")) + luminance(look.vector("background_bottom")));
    return background > kMiddleGray ? Vec3(0.01, 0.01, 0.01) : Vec3(0.93, 0.93, 0.93);
}

/// Unit of the quantity that colors show.
std::string_view unitOf(ColorBy colorBy) {
    if (colorBy == ColorBy::temperature) return "K";
    return colorBy == ColorBy::age ? "s" : "m/s";
}

render::ColorBar colorBarOf(const Section& section, const Look& look) {
    render::ColorBar bar;
    for (const Vec3& color : look.ramp) bar.colors.push_back(toFloat(color));
    bar.title = fmt::format("{} ({})", section.string("color_label"), unitOf(look.colorBy));
    bar.ticks = ticksBetween(look.rampLow, look.rampHigh);
    return bar;
}

}  // namespace

int samplesPerAxis(const Section& camera) {
    return static_cast<int>(std::sqrt(static_cast<double>(camera.integer("samples"))));
}

CameraPath buildCamera(std::vector<Section>& sections, BuildContext& context) {
    CameraPath path;
    for (Section& section : sections) {
        checkCamera(section, context);
        if (section.isValid()) checkLens(section, context);
    }
    if (sections.size() > 1) checkPath(sections, context);
    for (const Section& section : sections) {
        if (!section.isValid()) return {CameraKey{}};
        path.push_back({section.has("time") ? section.number("time") : 0.0, placementFrom(section)});
    }
    // Where some of the keys give a focus, the others have the target's, so that there is a number between all of them.
    if (std::ranges::any_of(path, [](const CameraKey& key) { return key.placement.focus > 0.0; }))
        for (CameraKey& key : path)
            if (key.placement.focus == 0.0) key.placement.focus = (key.placement.target - key.placement.eye).norm();
    for (const CameraJump& jump : jumpsOf(path))
        context.warnings.add(sections[jump.laterKey].position(),
                             fmt::format("on the way to this key, at {:.3g} s, the camera {}", jump.time,
                                         jump.cause == CameraJump::Cause::throughTarget
                                             ? "passes through its target and looks back; add a key beside the target"
                                             : "looks along up and the picture turns over; add a key beside that, or "
                                               "another up"));
    return path;
}

Look buildLook(Section& section, const CameraPath& camera, BuildContext& context) {
    Look look;
    const auto toLight = directionFrom(section, "light_direction", context);
    settleConflict(section, "colors", "color_map", context);
    if (section.isValid()) checkBlackBody(section, context);
    if (!section.isValid()) return look;
    readColors(section, context, look);
    // 30 m suits pictures that are a few meters high.
    const double halfHeight = halfHeightAtTarget(camera.front().placement);
    section.derive("ground_fade", TypedValue::ofNumber(std::clamp(30.0, 2.0 * halfHeight, 60.0 * halfHeight)));
    readView(section, look.common);
    look.common.light.toLight = toFloat(*toLight);
    if (look.common.surface.medium.isTransparent() && look.common.style == render::Style::spheres)
        context.warnings.add(section.position("transparency"),
                             "transparency is that of metaballs; look.style = \"spheres\" draws opaque particles");
    look.edgeWidth = toFloat(section.number("edge_width"));
    look.groundHeight = section.number("ground_height");
    return look;
}

void buildOverlay(Section& section, const Section& look, Scene& scene, BuildContext& context) {
    const bool isByMaterial = look.string("color_by") == "material";
    if (look.isValid() && isByMaterial && section.boolean("color_bar"))
        report(section, "color_bar", context,
               "color_bar is true, but colors by material have no scale; it needs look.color_by \"speed\" or \"age\"");
    const double scaleBar = section.number("scale_bar");
    if (scaleBar > 0.0) checkScaleBar(section, look, scene.camera, context);
    if (!isByMaterial) section.derive("color_label", TypedValue::ofString(look.string("color_by")));
    section.derive("ink", TypedValue::ofVector(contrastingInk(look)));
    if (!section.isValid() || !look.isValid()) return;
    scene.look.hasTimeStamp = section.boolean("time");
    render::Overlay& overlay = scene.look.common.overlay;
    if (scaleBar > 0.0) overlay.scaleBar = render::ScaleBar{toFloat(scaleBar), lengthText(scaleBar)};
    if (section.boolean("color_bar")) overlay.colorBar = colorBarOf(section, scene.look);
    overlay.ink = toFloat(section.vector("ink"));
    overlay.size = toFloat(section.number("size"));
}

}  // namespace scenes
