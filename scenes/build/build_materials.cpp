// [material]: a row of Table 1 or a substance, with what the scene changes of it.
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

/// Told apart at a glance on a light and a dark background; chosen for looks.
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
    const engine::Material preset = *engine::materialPreset(section.text("preset"));
    section.deriveText("name", preset.name);
    section.deriveNumber("radius", preset.radius);
    section.deriveNumber("mass", preset.mass);
    section.deriveNumber("b1", preset.repulsion);
    section.deriveNumber("bd", preset.damping);
    section.deriveNumber("cr", preset.repulsionReach);
    section.deriveNumber("cd", preset.dampingReach);
    section.deriveNumber("friction", preset.friction);
    section.deriveNumber("core", preset.coreFraction);
    section.deriveVector("color", presetColor(preset.name));
}

engine::Material materialFrom(const Section& section) {
    engine::Material material;
    material.name = section.text("name");
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

void checkName(Section& section, const Materials& earlier, BuildContext& context) {
    for (const engine::Material& material : earlier.list)
        if (material.name == section.text("name"))
            report(section, "name", fmt::format("there are two materials with the name {}", inQuotes(material.name)),
                   context);
}

}  // namespace

Materials buildMaterials(std::vector<Section>& sections, BuildContext& context) {
    Materials materials;
    for (Section& section : sections) {
        // A material that is not sound still has a name, so that those who use it are not blamed.
        engine::Material material;
        engine::Vec3 color = engine::Vec3::Zero();
        completeMaterial(section);
        if (section.has("name")) {
            checkName(section, materials, context);
            material.name = section.text("name");
        }
        if (section.isSound()) {
            material = materialFrom(section);
            color = section.vector("color");
        }
        materials.list.push_back(material);
        materials.colors.push_back(color);
    }
    return materials;
}

}  // namespace scenes
