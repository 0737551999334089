// Keys of [camera], [look] and [overlay]. Where the renderer has a default of its own in render/picture/view.h, the two
// are equal; a test compares them.
#include "scenes/schema/keys.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

/// Range of the color of a light, which may be brighter than 1. The upper bound is chosen to catch typing mistakes.
constexpr Range kLight{.low = 0.0, .high = 100.0};

/// A key whose value is the color of a light.
Key light(std::string_view name, std::string_view help) {
    return key(name, Type::color, "", help).within(kLight);
}

void append(std::vector<Key>& keys, std::vector<Key> more) {
    for (Key& row : more) keys.push_back(std::move(row));
}

std::vector<std::string_view> namesWithBlackBody() {
    std::vector<std::string_view> names = colorMapNames();
    names.push_back("black-body");
    return names;
}

std::vector<Key> colorKeys() {
    return {
        key("style", Type::choice, "", "particles one by one, or as one smooth surface")
            .defaultsTo("\"spheres\"")
            .oneOf({"spheres", "metaballs"}),
        key("size", Type::size, "pixels", "width and height of the picture")
            .defaultsTo("[1280, 720]")
            .within({16.0, 8192.0}),
        key("color_by", Type::choice, "", "quantity that the color of a particle shows")
            .defaultsTo("\"material\"")
            .oneOf({"material", "speed", "age", "temperature"}),
        key("colors", Type::colorList, "", "colors from low to high, evenly spaced, interpolated in linear light")
            .defaultsTo("[\"#1f4e9e\", \"#4fb3d9\", \"#f4f1de\"]")
            .within(kUnitInterval)
            .onlyFor({"speed", "age", "temperature"}),
        key("color_map", Type::choice, "",
            "a perceptually uniform color map instead of colors; black-body, only for temperature: the light of a hot "
            "body "
            "beside the color of its material")
            .derivedAs("colors is used")
            .oneOf(namesWithBlackBody())
            .onlyFor({"speed", "age", "temperature"}),
        key("color_range", Type::interval, "m/s, s or K", "quantities of the first and the last color")
            .derivedAs(
                "[0, 5] for speed, [0, duration] for age, [273.15, 373.15] for temperature, [800, 1500] for black-body")
            .onlyFor({"speed", "age", "temperature"}),
        color("background_top", "background at the upper edge of the picture").defaultsTo("\"#b4c4d4\""),
        color("background_bottom", "background at the lower edge of the picture").defaultsTo("\"#e6ebf0\""),
        color("edge_color", "color of the edges of boxes and containers").defaultsTo("[1, 0.9, 0]"),
        key("edge_width", Type::number, "pixels", "width of the edges of boxes and containers, at any quality")
            .defaultsTo("1.5")
            .within({0.0, 64.0, true}),
    };
}

std::vector<Key> lightKeys() {
    return {
        key("light_direction", Type::vec3, "", "direction toward the light, of any length")
            .defaultsTo("[0.4, 0.8, 0.45]"),
        light("light_color", "color of the light").defaultsTo("[1, 1, 1]"),
        light("rim_light", "color of a light behind the particles that brightens their outlines; 0: none")
            .defaultsTo("[0, 0, 0]"),
        key("shadows", Type::boolean, "", "whether the light casts shadows").defaultsTo("true"),
        light("ambient_sky", "ambient light from above").defaultsTo("[0.35, 0.35, 0.35]"),
        light("ambient_ground", "ambient light from below").defaultsTo("[0.2, 0.2, 0.2]"),
        share("specular", "specular reflectance of the particles at normal incidence; 0 is matte").defaultsTo("0"),
        key("gloss", Type::integer, "", "sharpness of highlights: their exponent is 2 to the power of this")
            .defaultsTo("6")
            .within({0.0, 10.0}),
        share("shadow_softness", "width of the penumbra in particle radii; 0 is sharp").defaultsTo("0"),
        share("occlusion", "strength of ambient occlusion: how much darker crevices are").defaultsTo("0"),
        key("exposure", Type::number, "",
            "factor of all light before highlights are compressed to below 1; 0 leaves the light as it is")
            .defaultsTo("0")
            .within({0.0, 10.0}),
        key("ground", Type::boolean, "", "whether a horizontal plane is drawn").defaultsTo("false"),
        key("ground_height", Type::number, "m", "height of the drawn plane").defaultsTo("0").within(kWithinWorld),
        color("ground_color", "color of the drawn plane").defaultsTo("[0.6, 0.6, 0.6]"),
        length("ground_fade", "distance at which the drawn plane has half faded into the background")
            .derivedAs("30, but from 2 to 60 times half the picture's height at the first camera's target"),
        key("metaball_reach", Type::number, "", "radius of a metaball's field in particle radii; larger is smoother")
            .defaultsTo("2.5")
            .within({1.2, 4.0}),
        key("skin", Type::choice, "",
            "surface of metaballs: around the particles as they are, around particles averaged with their neighbors, "
            "or around "
            "ellipsoids stretched along the surface, which is smoother still")
            .defaultsTo("\"plain\"")
            .oneOf({"plain", "smooth", "anisotropic"}),
    };
}

/// Keys of [look] on how the particles reflect, transmit and emit light.
std::vector<Key> surfaceKeys() {
    return {
        key("reflection", Type::number, "",
            "strength of mirror reflections of the surroundings, times the Fresnel term")
            .defaultsTo("0")
            .within({0.0, 4.0}),
        light("mirror_top", "reflected color of the surroundings above").defaultsTo("[0.9, 0.9, 0.9]"),
        light("mirror_horizon", "reflected color of the surroundings at the horizon").defaultsTo("[0.6, 0.6, 0.6]"),
        light("mirror_bottom", "reflected color of the surroundings below").defaultsTo("[0.2, 0.2, 0.2]"),
        share("metal", "1: reflections have the color of the particles, and there is no diffuse light").defaultsTo("0"),
        share("roughness", "1: as bright at the rim as in the middle, like dust").defaultsTo("0"),
        key("translucency", Type::number, "", "light from behind that shines through thin parts")
            .defaultsTo("0")
            .within({0.0, 4.0}),
        share("absorption", "how much more saturated and darker the color of thick parts is").defaultsTo("0"),
        share("transparency", "share of what is behind that shows through metaballs, as through water").defaultsTo("0"),
        refractiveIndexKey().defaultsTo("1.33"),
        attenuationKey(),
        key("glow", Type::number, "",
            "strength of the particles' own light, in the square of their color; lights what is around them")
            .defaultsTo("0")
            .within(kLight),
    };
}

}  // namespace

std::vector<Key> cameraKeys() {
    return {
        key("time", Type::number, "s", "when the camera is here; between the cameras of a list it moves smoothly")
            .derivedAs("required in a list")
            .within(kNotNegative)
            .notInherited(),
        key("projection", Type::choice, "", "perspective, or orthographic without foreshortening")
            .defaultsTo("\"perspective\"")
            .oneOf({"perspective", "orthographic"}),
        position("eye", "position of the camera").defaultsTo("[0, 2, 10]"),
        position("target", "point in the middle of the picture").defaultsTo("[0, 0, 0]"),
        key("up", Type::vec3, "", "direction that is upward in the picture, of any length").defaultsTo("[0, 1, 0]"),
        key("fov", Type::number, "degrees", "full vertical angle of view")
            .defaultsTo("40")
            .within({1.0, 170.0})
            .onlyFor({"perspective"}),
        length("half_height", "half the height of the picture").defaultsTo("5").onlyFor({"orthographic"}),
        key("aperture", Type::number, "m",
            "diameter of the lens, which blurs what is out of focus in pictures of --quality final; 0: a pinhole")
            .defaultsTo("0")
            .within({.low = 0.0, .high = engine::kWorldLimit})
            .onlyFor({"perspective"}),
        length("focus", "distance from the eye, along its axis, of the plane that is in focus")
            .derivedAs("the distance of the target")
            .onlyFor({"perspective"}),
        key("shutter", Type::number, "",
            "share of the time between two frames for which the shutter is open, around the frame's own moment, which "
            "blurs what moves in pictures of --quality final; 0: none of it")
            .defaultsTo("0")
            .within(kUnitInterval),
        key("samples", Type::integer, "",
            "samples of each pixel in pictures of --quality final, a square number; with aperture or shutter each is a "
            "whole picture, and strong blur takes more of them")
            .defaultsTo("9")
            .within({1.0, 1024.0}),
    };
}

std::vector<Key> lookKeys() {
    std::vector<Key> keys = colorKeys();
    append(keys, lightKeys());
    append(keys, surfaceKeys());
    return keys;
}

std::vector<Key> overlayKeys() {
    return {
        key("time", Type::boolean, "", "whether the time is shown, in the upper left corner").defaultsTo("false"),
        key("scale_bar", Type::number, "m",
            "length of the scale bar in the lower left corner, at the camera's target; 0: none")
            .defaultsTo("0")
            .within(kNotNegative),
        key("color_bar", Type::boolean, "", "whether a color bar for speed or age is shown, in the lower right corner")
            .defaultsTo("false"),
        key("color_label", Type::string, "", "name of the quantity at the color bar; its unit is added")
            .derivedAs("speed or age"),
        color("ink", "color of text and lines").derivedAs("dark or light, whichever contrasts with the background"),
        key("size", Type::number, "", "size of the text; 1 is 3 % of the picture's shorter side, at least 11 pixels")
            .defaultsTo("1")
            .within({0.5, 4.0}),
    };
}

}  // namespace scenes
