// [look].
#include "scenes/build/builders.h"
#include "scenes/schema/color_map.h"

namespace scenes {
namespace {

/// An override of the one takes the place of the other in the file.
bool overrules(const Section& section, std::string_view one, std::string_view other) {
    return section.isGiven(one) && section.at(one).overrideIndex >= 0 && section.at(other).overrideIndex < 0;
}

/// Of a map and colors in the file, both given, an override decides; the other is then no part of what the scene
/// means.
void settleRamp(Section& section, BuildContext& context) {
    if (!section.isGiven("colors") || !section.isGiven("color_map")) return;
    if (overrules(section, "color_map", "colors"))
        section.drop("colors");
    else if (overrules(section, "colors", "color_map"))
        section.drop("color_map");
    else
        reportBoth(section, "colors", "color_map", context);
}

std::vector<engine::Vec3> rampOf(const Section& section) {
    return section.has("color_map") ? colorMap(section.text("color_map")) : section.vectors("colors");
}

void readColors(const Section& section, Look& look) {
    look.backgroundTop = section.vector("background_top");
    look.backgroundBottom = section.vector("background_bottom");
    look.edgeColor = section.vector("edge_color");
    look.edgeWidth = section.number("edge_width");
    if (look.colorBy == ColorBy::material) return;
    look.ramp = rampOf(section);
    look.rampLow = section.numbers("color_range")[0];
    look.rampHigh = section.numbers("color_range")[1];
}

void readLight(const Section& section, Look& look) {
    look.lightColor = section.vector("light_color");
    look.shadows = section.flag("shadows");
    look.ambientSky = section.vector("ambient_sky");
    look.ambientGround = section.vector("ambient_ground");
    look.specular = section.number("specular");
    look.glossExponent = static_cast<int>(section.integer("gloss"));
    look.shadowSoftness = section.number("shadow_softness");
    look.occlusion = section.number("occlusion");
    look.exposure = section.number("exposure");
    look.ground = section.flag("ground");
    look.groundHeight = section.number("ground_height");
    look.groundColor = section.vector("ground_color");
    look.groundFade = section.number("ground_fade");
}

void readSurface(const Section& section, Look& look) {
    look.reflection = section.number("reflection");
    look.mirrorTop = section.vector("mirror_top");
    look.mirrorHorizon = section.vector("mirror_horizon");
    look.mirrorBottom = section.vector("mirror_bottom");
    look.metal = section.number("metal");
    look.roughness = section.number("roughness");
    look.translucency = section.number("translucency");
    look.absorption = section.number("absorption");
    look.glow = section.number("glow");
}

}  // namespace

Look buildLook(Section& section, BuildContext& context) {
    Look look;
    const auto toLight = unitVector(section.vector("light_direction"));
    if (!toLight) report(section, "light_direction", "light_direction is [0, 0, 0], must not be zero", context);
    settleRamp(section, context);
    if (!section.isSound()) return look;
    look.toLight = *toLight;
    look.style = section.text("style") == "metaballs" ? render::Style::metaballs : render::Style::spheres;
    const std::string& colorBy = section.text("color_by");
    look.colorBy = colorBy == "speed" ? ColorBy::speed : colorBy == "age" ? ColorBy::age : ColorBy::material;
    if (look.colorBy == ColorBy::speed) section.deriveInterval("color_range", 0.0, 5.0);
    if (look.colorBy == ColorBy::age) section.deriveInterval("color_range", 0.0, context.duration);
    readColors(section, look);
    readLight(section, look);
    readSurface(section, look);
    look.metaballReach = section.number("metaball_reach");
    look.skin = section.text("skin") == "smooth" ? render::Skin::smooth : render::Skin::plain;
    return look;
}

}  // namespace scenes
