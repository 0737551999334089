// Makes the materials of particles from the [material] tables of a scene: a preset, in which the keys that are given
// replace the preset's values.
#include <array>
#include <map>
#include <string_view>

#include "scenes/build/builders.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

/// Colors of particles by preset of their material, sRGB. Chosen: easy to tell apart on light and dark backgrounds.
const std::map<std::string_view, std::string_view> kPresetColors = {
    {"liquid", "#3f86c8"}, {"solid", "#c8794a"},        {"powder", "#d8b878"}, {"fountain", "#58a8dc"},
    {"honey", "#d98a12"},  {"jam", "#9c1430"},          {"oil", "#d9b63a"},    {"lava", "#ff5a14"},
    {"mud", "#6b4a2f"},    {"molten-metal", "#ffb347"}, {"sand", "#d9b36c"}};

/// A key of [material] and the number of engine::Material that it sets.
struct MaterialKey {
    std::string_view name;
    double engine::Material::*member;
};

constexpr std::array<MaterialKey, 8> kMaterialKeys = {{{"radius", &engine::Material::radius},
                                                       {"mass", &engine::Material::mass},
                                                       {"b1", &engine::Material::repulsion},
                                                       {"bd", &engine::Material::damping},
                                                       {"cr", &engine::Material::repulsionReach},
                                                       {"cd", &engine::Material::dampingReach},
                                                       {"friction", &engine::Material::friction},
                                                       {"core", &engine::Material::coreFraction}}};

/// Sets the keys of [material] that the scene leaves out to the values of the preset.
void completeMaterial(Section& section) {
    const engine::Material preset = *engine::materialPreset(section.string("preset"));
    section.derive("name", TypedValue::ofString(preset.name));
    for (const MaterialKey& key : kMaterialKeys) section.derive(key.name, TypedValue::ofNumber(preset.*key.member));
    section.derive("color", TypedValue::ofVector(*colorFromHex(kPresetColors.at(preset.name))));
}

void checkName(Section& section, const Materials& previous, BuildContext& context) {
    for (const engine::Material& material : previous.list)
        if (material.name == section.string("name"))
            report(section, "name", context, "there are two materials with the name {}", tomlString(material.name));
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
            for (const MaterialKey& key : kMaterialKeys) material.*key.member = section.number(key.name);
            color = section.vector("color");
        }
        materials.list.push_back(material);
        materials.colors.push_back(color);
    }
    return materials;
}

}  // namespace scenes
