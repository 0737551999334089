// Makes the heat of a scene, which it has if a material has a heat capacity, from keys of several tables; and how often
// particles are agitated.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/forces/force_field.h"
#include "engine/heat/agitation.h"
#include "scenes/build/builders.h"

namespace scenes {
namespace {

/// The keys of heat of each kind of table; none of them means anything in a scene without heat.
constexpr std::array<std::string_view, 6> kOfMaterial = {"conductivity", "melting",  "melting_range",
                                                         "latent",       "melts_to", "temperature"};
constexpr std::array<std::string_view, 3> kOfAir = {"temperature", "exchange", "emissivity"};
constexpr std::array<std::string_view, 1> kTemperature = {"temperature"};

/// Records a problem with the first key of heat that a table has, if it has one.
void refuseHeat(Section& section, std::span<const std::string_view> names, BuildContext& context) {
    for (const std::string_view name : names)
        if (section.isGiven(name))
            return report(section, name, context, "{} needs heat: give the materials a capacity (J/(kg K))", name);
}

void refuseHeat(Sections& sections, BuildContext& context) {
    for (Section& section : sections.materials) refuseHeat(section, kOfMaterial, context);
    refuseHeat(sections.air, kOfAir, context);
    for (auto* list : {&sections.bodies, &sections.emitters, &sections.obstacles})
        for (Section& section : *list) refuseHeat(section, kTemperature, context);
    if (sections.look.has("color_by") && sections.look.string("color_by") == "temperature")
        report(sections.look, "color_by", context,
               "color_by = \"temperature\" needs heat: give the materials a capacity (J/(kg K))");
}

/// Checks the keys of a material with or without a capacity in a scene with heat.
void checkMaterial(Section& section, BuildContext& context) {
    if (!section.isGiven("capacity"))
        return report(section, "name", context,
                      "capacity is missing, every material of a scene with heat needs it (J/(kg K))");
    if (section.has("melting")) return;
    for (const std::string_view name : {"melting_range", "latent", "melts_to"})
        if (section.isGiven(name)) return report(section, name, context, "{} needs a melting temperature", name);
}

/// The index of the material that a table melts to; nothing, with the problem recorded, if there is none.
std::optional<std::uint32_t> meltedOf(Section& section, const Materials& materials, BuildContext& context) {
    const std::string& name = section.string("melts_to");
    const auto found = std::ranges::find(materials.list, name, &engine::Material::name);
    if (found == materials.list.end())
        report(section, "melts_to", context, "there is no material with the name {}", tomlString(name));
    else if (name == section.string("name"))
        report(section, "melts_to", context, "a material cannot melt to itself");
    else
        return static_cast<std::uint32_t>(found - materials.list.begin());
    return std::nullopt;
}

/// The number of stages of each of some materials that melt: as many as the tables of the pair law have room for.
std::uint32_t stageCount(std::size_t materials, std::size_t melts) {
    std::uint32_t count = engine::kMostStages;
    while (count > 1 && materials + melts * count > engine::kMostTabulated) count /= 2;
    return count;
}

/// Adds the stages of a material that melts.
engine::Melt addStages(std::uint32_t solid, std::uint32_t melted, std::uint32_t count, Materials& materials) {
    const engine::Material from = materials.list[solid];
    const engine::Material to = materials.list[melted];
    const engine::Melt melt{solid, static_cast<std::uint32_t>(materials.list.size()), count};
    for (engine::Material& stage : engine::stagesOf(from, to, count)) {
        const double share = static_cast<double>(materials.list.size() - melt.first + 1) / count;
        stage.name = fmt::format("{}, {:.0f} % melted", from.name, 100.0 * share);
        materials.list.push_back(stage);
        materials.colors.push_back((1.0 - share) * materials.colors[solid] + share * materials.colors[melted]);
        materials.sections.push_back(materials.sections[solid]);
        materials.notes.push_back(fmt::format("a stage of {} on its way to {}", from.name, to.name));
    }
    return melt;
}

std::vector<engine::Melt> addMelts(Materials& materials, BuildContext& context) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const std::size_t given = materials.list.size();
    for (std::uint32_t index = 0; index < given; ++index) {
        Section& section = *materials.sections[index];
        if (!section.isValid() || !section.has("melts_to")) continue;
        const auto melted = meltedOf(section, materials, context);
        if (melted && materials.sections[*melted]->isValid())
            pairs.emplace_back(index, materialAtRadius(materials, *melted, materials.list[index].radius));
    }
    std::vector<engine::Melt> melts;
    const std::uint32_t count = stageCount(materials.list.size(), pairs.size());
    for (const auto& [solid, melted] : pairs) melts.push_back(addStages(solid, melted, count, materials));
    return melts;
}

/// The longest time (s) that divides a frame evenly and is no longer than this.
double partOfFrame(const Section& top, double longest) {
    const double frame = top.frameRate("fps").timeOf(1);
    return frame / std::ceil(frame / longest);
}

/// Temperature of the particles of a body or an emitter, K.
double temperatureFor(const Section& section, const Section& material) {
    if (section.has("temperature")) return section.number("temperature");
    return material.has("temperature") ? material.number("temperature") : engine::kRoomTemperature;
}

}  // namespace

double enthalpyOf(const Section& section, const Materials& materials, std::uint32_t material, double mass) {
    const engine::Thermal& thermal = materials.list[material].thermal;
    if (!thermal.exists()) return std::numeric_limits<double>::quiet_NaN();
    return mass * engine::enthalpyAt(thermal, temperatureFor(section, *materials.sections[material]));
}

void buildHeat(Sections& sections, Materials& materials, Scene& scene, BuildContext& context) {
    const auto hasCapacity = [](const Section& section) { return section.isGiven("capacity"); };
    if (std::ranges::none_of(sections.materials, hasCapacity)) return refuseHeat(sections, context);
    for (Section& section : sections.materials) checkMaterial(section, context);
    engine::HeatSetup& heat = scene.setup.heat.emplace();
    heat.melts = addMelts(materials, context);
    if (sections.air.isValid())
        heat.air = {.temperature = sections.air.number("temperature"),
                    .exchange = sections.air.number("exchange"),
                    .emissivity = sections.air.number("emissivity")};
    for (const Section& section : sections.obstacles) {
        if (!section.isValid()) continue;
        const bool isGiven = section.has("temperature");
        heat.obstacles.push_back(isGiven ? std::optional(section.number("temperature")) : std::nullopt);
    }
    for (std::size_t e = 0; e < scene.setup.emitters.size(); ++e) {
        engine::Emitter& emitter = scene.setup.emitters[e];
        emitter.temperature = temperatureFor(sections.emitters[e], *materials.sections[emitter.material]);
    }
    if (sections.physics.isValid() && sections.top.isValid())
        heat.interval = partOfFrame(sections.top, sections.physics.number("heat_step"));
    engine::Particles& particles = scene.setup.initial;
    for (std::size_t p = 0; p < particles.enthalpy.size(); ++p)
        particles.material[p] =
            engine::stageAt(heat, materials.list, particles.material[p], particles.enthalpy[p] / particles.mass[p]);
}

void buildAgitation(const Sections& sections, const Materials& materials, engine::Setup& setup) {
    double longest = std::numeric_limits<double>::infinity();
    for (const engine::Material& material : materials.list)
        longest = std::min(longest, engine::agitationInterval(material));
    if (std::isfinite(longest) && sections.top.isValid()) setup.agitationInterval = partOfFrame(sections.top, longest);
}

}  // namespace scenes
