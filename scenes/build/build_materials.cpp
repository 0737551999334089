// Makes the materials of particles from the [material] tables of a scene: a preset, in which the keys that are given
// replace the preset's values. What a table leaves out of mass, b1 and bd follows from the radius, so that a preset
// stays the same substance at any size of its particles.
#include <array>
#include <cmath>
#include <string_view>

#include "engine/force_law/cohesion.h"
#include "engine/heat/agitation.h"
#include "scenes/build/builders.h"
#include "scenes/build/columns.h"
#include "scenes/schema/preset_info.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

/// A key of [material] and the number of engine::Material that it sets.
struct MaterialKey {
    std::string_view name;
    double engine::Material::*member;
};

constexpr std::array<MaterialKey, 10> kMaterialKeys = {{{"radius", &engine::Material::radius},
                                                        {"mass", &engine::Material::mass},
                                                        {"b1", &engine::Material::repulsion},
                                                        {"bd", &engine::Material::damping},
                                                        {"cr", &engine::Material::repulsionReach},
                                                        {"cd", &engine::Material::dampingReach},
                                                        {"cohesion", &engine::Material::cohesion},
                                                        {"agitation", &engine::Material::agitation},
                                                        {"friction", &engine::Material::friction},
                                                        {"core", &engine::Material::coreFraction}}};

/// The keys that follow from the radius where they are not given.
constexpr std::array<MaterialKey, 3> kFollowing = {kMaterialKeys[1], kMaterialKeys[2], kMaterialKeys[3]};

/// "mass 0.064, b1 4.1e-05" for those of the keys that follow from the radius.
std::string followingText(const engine::Material& material, const auto& follows) {
    std::vector<std::string> parts;
    for (const MaterialKey& key : kFollowing)
        if (follows(key.name)) parts.push_back(fmt::format("{} {:.3g}", key.name, material.*key.member));
    if (parts.empty()) return "mass, b1 and bd are given";
    return fmt::format("{} follow{}", fmt::join(parts, ", "), parts.size() == 1 ? "s" : "");
}

/// The substance of a [material] table before its own constants are set: the preset with particles of the table's
/// radius, and at the scene's resolution.
engine::Material presetOf(const Section& section) {
    const engine::Material preset = *engine::materialPreset(section.string("preset"));
    return section.has("radius") ? engine::withRadius(preset, section.number("radius")) : preset;
}

/// Divides the radius of a table by the scene's resolution, and lets the constants that are given follow.
void refine(Section& section, double resolution) {
    const engine::Material preset = *engine::materialPreset(section.string("preset"));
    section.derive("radius", TypedValue::ofNumber(preset.radius));
    if (resolution == 1.0 || !section.isValid()) return;
    engine::Material given = preset;
    for (const MaterialKey& key : kMaterialKeys)
        if (section.has(key.name)) given.*key.member = section.number(key.name);
    given = engine::withRadius(given, given.radius / resolution);
    for (const MaterialKey& key : kMaterialKeys)
        if (section.has(key.name))
            section.put(key.name, TypedValue::ofNumber(given.*key.member), section.position(key.name),
                        section.origin(key.name));
}

/// Sets the keys of [material] that the scene leaves out to the values of the preset.
void completeMaterial(Section& section, double resolution) {
    refine(section, resolution);
    const engine::Material preset = presetOf(section);
    section.derive("name", TypedValue::ofString(preset.name));
    for (const MaterialKey& key : kMaterialKeys) section.derive(key.name, TypedValue::ofNumber(preset.*key.member));
    section.derive("color", TypedValue::ofVector(*colorFromHex(presetInfo(preset.name).color)));
}

void checkName(Section& section, const Materials& previous, BuildContext& context) {
    for (const engine::Material& material : previous.list)
        if (material.name == section.string("name"))
            report(section, "name", context, "there are two materials with the name {}", tomlString(material.name));
}

/// Records a problem if the resolution, or a radius far from the preset's, makes particles that the engine does not
/// accept.
void checkRanges(Section& section, BuildContext& context) {
    for (const std::string_view name : {"radius", "mass"}) {
        const Range& range = findKey("material", name)->range;
        const double value = section.number(name);
        if (value < range.low || value > range.high)
            report(section, name, context, "the {} would be {:.7g}, must be {}", name, value, rangeText(range));
    }
}

/// Why mass, b1 and bd of a material are what they are, for `check`; empty where they are those of its preset.
std::string noteOn(const Section& section, const engine::Material& material, double resolution) {
    const double presetRadius = engine::materialPreset(section.string("preset"))->radius;
    if (material.radius == presetRadius && resolution == 1.0) return {};
    const auto follows = [&](std::string_view key) {
        const bool isChosen = key == "b1" && section.isGiven("compression");
        return !isChosen && (resolution != 1.0 || !section.isGiven(key));
    };
    return fmt::format("radius {:.3g}{} is {:.3g} times that of the preset {}: {}", material.radius,
                       resolution == 1.0 ? "" : fmt::format(" at resolution {:g}", resolution),
                       material.radius / presetRadius, section.string("preset"), followingText(material, follows));
}

/// Chooses b1 of a material for the wanted compression, and returns what was done, for `check`.
std::string chooseRepulsion(Section& section, const engine::Material& material, const std::vector<Section>& bodies,
                            BuildContext& context) {
    const auto column = columnFor(section, material, bodies, context);
    if (!column) return {};
    const double wanted = 1.0 - section.number("compression");
    const auto repulsion = engine::repulsionForShare(material, *column, wanted);
    if (!repulsion) {
        report(section, "compression", context,
               "compression is {}, but particles {:.3g} m apart sink further, however strong their repulsion is: give "
               "the body a smaller spacing",
               section.canonical("compression"), column->spacing);
        return {};
    }
    if (!std::isfinite(*repulsion)) {
        report(section, "compression", context, "compression and depth would need a b1 of {:g} N m^4", *repulsion);
        return {};
    }
    section.derive("b1", TypedValue::ofNumber(*repulsion));
    return fmt::format("compression {} of {:.3g} m: b1 {:.3g}", section.canonical("compression"), column->height,
                       *repulsion);
}

/// Gives a material its cohesion, and returns what that means, for `check`.
std::string cohere(Section& section, engine::Material& material, BuildContext& context) {
    if (material.cohesion == 0.0) return {};
    const double repulsion = material.repulsion;
    const auto cohesive = engine::withCohesion(material, material.cohesion);
    if (!cohesive) {
        report(
            section, "cohesion", context,
            "cohesion needs a cr of at most {:.4g}, which is {}: particles that attract beyond their nearest neighbors "
            "draw together by themselves",
            engine::kMostCohesiveReach, section.canonical("cr"));
        return {};
    }
    material = *cohesive;
    std::string note = fmt::format("cohesion {} N/m", section.canonical("cohesion"));
    if (material.pull == 0.0)
        note += fmt::format(" is no more than cr makes already, {:.3g}", surfaceTension(material));
    if (material.repulsion > repulsion)
        note += fmt::format(" raises b1 {:.3g} times to {:.3g}", material.repulsion / repulsion, material.repulsion);
    const double gravity = std::sqrt(engine::squaredLength(context.gravity));
    if (gravity > 0.0)
        note += fmt::format("; drops are flattened by their weight above a radius of about {:.2g} m",
                            engine::capillaryLength(material, gravity));
    return note;
}

/// Checks that a material with random motion has what it needs, and returns what that means, for `check`.
std::string agitate(Section& section, const engine::Material& material, BuildContext& context) {
    if (material.agitation == 0.0) return {};
    if (material.cohesion == 0.0) {
        report(section, "agitation", context,
               "agitation is a share of the energy of a surface: the material needs a cohesion above 0");
        return {};
    }
    if (material.damping == 0.0) {
        report(section, "agitation", context,
               "agitation gives back what damping takes: the material needs a bd above 0");
        return {};
    }
    return fmt::format("agitation {}: its particles move at {:.2g} m/s, and drops are rough by {:.2g} m",
                       section.canonical("agitation"),
                       std::sqrt(3.0 * engine::agitationEnergy(material) / material.mass),
                       std::sqrt(engine::agitationEnergy(material) / material.cohesion));
}

/// Chooses between b1 and compression where both are given. Without compression there is no depth.
void settleRepulsion(Section& section, BuildContext& context) {
    const bool isCompressed = section.isGiven("compression");
    settleConflict(section, "b1", "compression", context);
    if (isCompressed && !section.isGiven("compression")) section.erase("depth");
}

/// The thermal constants of a material with a heat capacity.
engine::Thermal thermalFrom(const Section& section) {
    engine::Thermal thermal;
    thermal.capacity = section.number("capacity");
    if (section.has("conductivity")) thermal.conductivity = section.number("conductivity");
    if (section.has("melting")) thermal.melting = section.number("melting");
    if (section.has("melting_range")) thermal.meltingRange = section.number("melting_range");
    if (section.has("latent")) thermal.latent = section.number("latent");
    return thermal;
}

void addNote(std::string& notes, const std::string& note) {
    notes += (notes.empty() || note.empty() ? "" : "; ") + note;
}

void appendMaterial(Section& section, Materials& materials, BuildContext& context) {
    // An invalid material keeps its name, so that no body that uses it is reported for an undefined material.
    engine::Material material;
    engine::Vec3 color = engine::Vec3::Zero();
    settleRepulsion(section, context);
    completeMaterial(section, context.resolution);
    if (section.has("name")) {
        checkName(section, materials, context);
        material.name = section.string("name");
    }
    if (section.isValid()) checkRanges(section, context);
    if (section.isValid()) {
        for (const MaterialKey& key : kMaterialKeys) material.*key.member = section.number(key.name);
        color = section.vector("color");
        if (section.has("capacity")) material.thermal = thermalFrom(section);
    }
    materials.list.push_back(material);
    materials.colors.push_back(color);
    materials.sections.push_back(&section);
    materials.notes.push_back(section.isValid() ? noteOn(section, material, context.resolution) : "");
}

}  // namespace

Materials buildMaterials(std::vector<Section>& sections, const std::vector<Section>& bodies, BuildContext& context) {
    Materials materials;
    for (Section& section : sections) appendMaterial(section, materials, context);
    // The bodies find their material by its name, which all materials have by now.
    for (std::size_t index = 0; index < sections.size(); ++index) {
        Section& section = sections[index];
        if (checkCompression(section, context)) {
            const std::string note = chooseRepulsion(section, materials.list[index], bodies, context);
            if (!section.isValid()) continue;
            materials.list[index].repulsion = section.number("b1");
            addNote(materials.notes[index], note);
        }
        if (section.isValid()) addNote(materials.notes[index], cohere(section, materials.list[index], context));
        if (section.isValid()) addNote(materials.notes[index], agitate(section, materials.list[index], context));
    }
    return materials;
}

std::uint32_t materialAtRadius(Materials& materials, std::uint32_t index, double radius) {
    engine::Material original = materials.list[index];
    Section& section = *materials.sections[index];
    if (radius == original.radius) return index;
    original.repulsion = section.number("b1");  // before cohesion has raised it
    engine::Material derived = engine::withRadius(original, radius);
    for (const MaterialKey& key : kFollowing)
        if (section.isGiven(key.name)) derived.*key.member = original.*key.member;
    derived = engine::withCohesion(derived, derived.cohesion).value_or(derived);
    derived.name = fmt::format("{} at radius {:.7g}", original.name, radius);
    for (std::uint32_t other = 0; other < materials.list.size(); ++other)
        if (materials.list[other].name == derived.name) return other;
    materials.list.push_back(derived);
    materials.colors.push_back(engine::Vec3(materials.colors[index]));
    materials.sections.push_back(&section);
    const auto follows = [&](std::string_view key) { return !section.isGiven(key); };
    materials.notes.push_back(fmt::format("particle_radius {:.3g} is {:.3g} times the radius of the material {}: {}",
                                          radius, radius / original.radius, original.name,
                                          followingText(derived, follows)));
    return static_cast<std::uint32_t>(materials.list.size() - 1);
}

}  // namespace scenes
