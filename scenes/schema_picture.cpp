// Rows of the schema: [camera], [look], [overlay] and [still]. Where a default repeats render/view.h, the two agree.
#include "scenes/color_map.h"
#include "scenes/schema_rows.h"

namespace scenes {
namespace {

/// Brighter lamps than this are a slip of the finger; a colour may exceed 1 because light may.
constexpr Range kLight{.low = 0.0, .high = 100.0};

std::vector<Key> cameraRows() {
    return {
        {.path = "camera[].time",
         .unit = "s",
         .derived = "needed in a list",
         .range = kNotNegative,
         .help = "when it is seen from here; in between the camera glides"},
        {.path = "camera[].projection",
         .type = Type::choice,
         .fallback = "\"perspective\"",
         .choices = {"perspective", "orthographic"},
         .help = "how depth is drawn"},
        {.path = "camera[].eye",
         .type = Type::vec3,
         .unit = "m",
         .fallback = "[0, 2, 10]",
         .help = "where the camera is"},
        {.path = "camera[].target",
         .type = Type::vec3,
         .unit = "m",
         .fallback = "[0, 0, 0]",
         .help = "what is in the middle of the picture"},
        {.path = "camera[].up",
         .type = Type::vec3,
         .fallback = "[0, 1, 0]",
         .help = "upwards in the picture; any length"},
        {.path = "camera[].fov",
         .unit = "degrees",
         .fallback = "40",
         .range = {.low = 1.0, .high = 170.0},
         .appliesTo = {"perspective"},
         .help = "full vertical angle of view"},
        {.path = "camera[].half_height",
         .unit = "m",
         .fallback = "5",
         .range = kPositive,
         .appliesTo = {"orthographic"},
         .help = "half the height of the picture"},
    };
}

std::vector<Key> colorRows() {
    return {
        {.path = "look.style",
         .type = Type::choice,
         .fallback = "\"spheres\"",
         .choices = {"spheres", "metaballs"},
         .help = "particles one by one, or as one smooth surface"},
        {.path = "look.size",
         .type = Type::size,
         .unit = "pixels",
         .fallback = "[1280, 720]",
         .range = {.low = 16.0, .high = 8192.0},
         .help = "width and height of the picture"},
        {.path = "look.color_by",
         .type = Type::choice,
         .fallback = "\"material\"",
         .choices = {"material", "speed", "age"},
         .help = "what a particle's colour shows"},
        {.path = "look.colors",
         .type = Type::colorList,
         .fallback = "[\"#1f4e9e\", \"#4fb3d9\", \"#f4f1de\"]",
         .range = kUnitInterval,
         .appliesTo = {"speed", "age"},
         .help = "from low to high, evenly spaced, interpolated in linear light"},
        {.path = "look.color_map",
         .type = Type::choice,
         .derived = "the colors above",
         .choices = {colorMapNames().begin(), colorMapNames().end()},
         .appliesTo = {"speed", "age"},
         .help = "a perceptually uniform map in place of colors"},
        {.path = "look.color_range",
         .type = Type::interval,
         .unit = "m/s or s",
         .derived = "[0, 5] for speed, [0, duration] for age",
         .appliesTo = {"speed", "age"},
         .help = "speeds or ages of the first and the last colour"},
        {.path = "look.background_top",
         .type = Type::color,
         .fallback = "\"#b4c4d4\"",
         .range = kUnitInterval,
         .help = "at the upper edge of the picture"},
        {.path = "look.background_bottom",
         .type = Type::color,
         .fallback = "\"#e6ebf0\"",
         .range = kUnitInterval,
         .help = "at the lower edge of the picture"},
        {.path = "look.edge_color",
         .type = Type::color,
         .fallback = "[1, 0.9, 0]",
         .range = kUnitInterval,
         .help = "of the edges of boxes and containers"},
        {.path = "look.edge_width",
         .unit = "pixels",
         .fallback = "1.5",
         .range = {.low = 0.0, .high = 64.0, .lowOpen = true},
         .help = "of those edges, at any quality"},
    };
}

std::vector<Key> lightRows() {
    return {
        {.path = "look.light_direction",
         .type = Type::vec3,
         .fallback = "[0.4, 0.8, 0.45]",
         .help = "towards the light; any length"},
        {.path = "look.light_color",
         .type = Type::color,
         .fallback = "[1, 1, 1]",
         .range = kLight,
         .help = "of the light"},
        {.path = "look.shadows", .type = Type::boolean, .fallback = "true", .help = "cast by the light"},
        {.path = "look.ambient_sky",
         .type = Type::color,
         .fallback = "[0.35, 0.35, 0.35]",
         .range = kLight,
         .help = "light from above that comes from everywhere"},
        {.path = "look.ambient_ground",
         .type = Type::color,
         .fallback = "[0.2, 0.2, 0.2]",
         .range = kLight,
         .help = "light from below that comes from everywhere"},
        {.path = "look.specular",
         .fallback = "0",
         .range = kUnitInterval,
         .help = "mirror reflection of the particles seen head-on; 0 is matt"},
        {.path = "look.gloss",
         .type = Type::integer,
         .fallback = "6",
         .range = {.low = 0.0, .high = 10.0},
         .help = "sharpness of highlights: their exponent is 2 to the power of this"},
        {.path = "look.ground", .type = Type::boolean, .fallback = "false", .help = "a horizontal plane is drawn"},
        {.path = "look.ground_height", .unit = "m", .fallback = "0", .help = "its height"},
        {.path = "look.ground_color",
         .type = Type::color,
         .fallback = "[0.6, 0.6, 0.6]",
         .range = kUnitInterval,
         .help = "its colour"},
        {.path = "look.ground_fade",
         .unit = "m",
         .fallback = "30",
         .range = kPositive,
         .help = "distance at which it has half faded into the background"},
        {.path = "look.metaball_reach",
         .fallback = "2.5",
         .range = {.low = 1.2, .high = 4.0},
         .help = "radius of a metaball's field in particle radii; more is smoother"},
    };
}

std::vector<Key> overlayRows() {
    return {
        {.path = "overlay.time",
         .type = Type::boolean,
         .fallback = "false",
         .help = "the time of the moment, in the upper left corner"},
        {.path = "overlay.scale_bar",
         .unit = "m",
         .fallback = "0",
         .range = kNotNegative,
         .help = "a bar as long as this is at the camera's target, in the lower left corner; 0 is none"},
        {.path = "overlay.color_bar",
         .type = Type::boolean,
         .fallback = "false",
         .help = "which colour is which speed or age, in the lower right corner"},
        {.path = "overlay.color_label",
         .type = Type::text,
         .derived = "speed or age",
         .help = "what the colour bar calls it; the unit follows"},
        {.path = "overlay.ink",
         .type = Type::color,
         .derived = "dark or light, whichever contrasts with the background",
         .range = kUnitInterval,
         .help = "of text and lines"},
        {.path = "overlay.size",
         .fallback = "1",
         .range = {.low = 0.5, .high = 4.0},
         .help = "of the text; 1 is 3 % of the picture's shorter side, at least 11 pixels"},
    };
}

}  // namespace

std::vector<Key> pictureRows() {
    std::vector<Key> rows = cameraRows();
    for (const std::vector<Key>& part : {colorRows(), lightRows(), overlayRows()})
        rows.insert(rows.end(), part.begin(), part.end());
    rows.push_back({.path = "still.time",
                    .unit = "s",
                    .derived = "half the duration",
                    .range = kNotNegative,
                    .help = "the moment that stands for the scene"});
    rows.push_back({.path = "still.strip",
                    .type = Type::numberList,
                    .unit = "s",
                    .derived = "the four quarters of the duration",
                    .range = kNotNegative,
                    .help = "the moments side by side in its strip"});
    return rows;
}

}  // namespace scenes
