// Builds materials: a preset, with the values that the scene gives instead of the preset's: [material].
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "scenes/build/builders.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

struct PresetColor {
    std::string_view preset, hex;
};

/// Chosen: easy to tell apart on light and dark backgrounds.
constexpr std::array<PresetColor, 11> kPresetColors = {{{"liquid", "#3f86c8"},
                                                        {"solid", "#c8794a"},
                                                        {"powder", "#d8b878"},
                                                        {"fountain", "#58a8dc"},
                                                        {"honey", "#d98a12"},
                                                        {"jam", "#9c1430"},
                                                        {"oil", "#d9b63a"},
                                                        {"lava", "#ff5a14"},
                                                        {"mud", "#6b4a2f"},
                                                        {"molten-metal", "#ffb347"},
                                                        {"sand", "#d9b36c"}}};

engine::Vec3 presetColor(const std::string& preset) {
    const auto* row = std::find_if(kPresetColors.begin(), kPresetColors.end(),
                                   [&](const PresetColor& color) { return color.preset == preset; });
    return *colorFromHex(row == kPresetColors.end() ? kPresetColors.front().hex : row->hex);
}

/// Gives the keys that the scene leaves out the values of the preset.
void completeMaterial(Section& section) {
    const engine::Material preset = *engine::materialPreset(section.string("preset"));
    section.derive("name", TypedValue::ofString(preset.name));
    section.derive("radius", TypedValue::ofNumber(preset.radius));
    section.derive("mass", TypedValue::ofNumber(preset.mass));
    section.derive("b1", TypedValue::ofNumber(preset.repulsion));
    section.derive("bd", TypedValue::ofNumber(preset.damping));
    section.derive("cr", TypedValue::ofNumber(preset.repulsionReach));
    section.derive("cd", TypedValue::ofNumber(preset.dampingReach));
    section.derive("friction", TypedValue::ofNumber(preset.friction));
    section.derive("core", TypedValue::ofNumber(preset.coreFraction));
    section.derive("color", TypedValue::ofVector(presetColor(preset.name)));
}

engine::Material materialFrom(const Section& section) {
    engine::Material material;
    material.name = section.string("name");
    material.radius = section.number("radius");
    material.mass = section.number("mass");
    material.repulsion = section.number("b1");
    material.damping = section.number("bd");
    material.repulsionReach = section.number("cr");
    material.dampingReach = section.number("cd");
    material.friction = section.number("friction");
    material.coreFraction = section.number("core");
    return material;
}

void checkName(Section& section, const Materials& previous, BuildContext& context) {
    for (const engine::Material& material : previous.list)
        if (material.name == section.string("name"))
            report(section, "name", fmt::format("there are two materials with the name {}", tomlString(material.name)),
                   context);
}

}  // namespace

Materials buildMaterials(std::vector<Section>& sections, BuildContext& context) {
    Materials materials;
    for (Section& section : sections) {
        // An invalid material keeps its name, so that no body that uses it is reported for an undefined material.
        engine::Material material;
        engine::Vec3 color = engine::Vec3::Zero();
        completeMaterial(section);
        if (section.has("name")) {
            checkName(section, materials, context);
            material.name = section.string("name");
        }
        if (section.isValid()) {
            material = materialFrom(section);
            color = section.vector("color");
        }
        materials.list.push_back(material);
        materials.colors.push_back(color);
    }
    return materials;
}

}  // namespace scenes
