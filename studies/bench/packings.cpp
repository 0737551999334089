// Makes the lattices of the benchmark from a cube of particles that are alike.
#include "studies/bench/packings.h"

#include <algorithm>
#include <array>

#include "engine/core/bounding_box.h"
#include "engine/core/random.h"
#include "studies/common/fcc_cube.h"

namespace studies {
namespace {

/// Most lattices have neighbors at the rest length; one has the spacing of a solid that has settled under its own
/// attraction, as measured in scenes/library/solid.toml. That of unequal radii has as many neighbors within the cutoff
/// as the liquid: at the rest length it would have half as many again, because the fourth shell lies at the cutoff.
constexpr std::array kPackings = {Packing{"solid", "solid"},
                                  Packing{"settled solid", "solid", 0.76},
                                  Packing{"melt", "solid", 1.0, Differences::sixteenLaws},
                                  Packing{"heated melts", "solid", 1.0, Differences::heat},
                                  Packing{"liquid", "liquid"},
                                  Packing{"unequal", "liquid", 1.2, Differences::radii},
                                  Packing{"powder", "powder"},
                                  Packing{"two powders", "powder", 1.0, Differences::twoLaws}};

/// A powder, and another that is stiffer and more damped.
std::vector<engine::Material> powders(const engine::Material& powder) {
    std::vector<engine::Material> materials = {powder, powder};
    materials[1].repulsion *= 2.0;
    materials[1].damping *= 1.5;
    return materials;
}

/// Sixteen stages of melting, from the solid to a material that is softer, less damped and hardly attracts.
std::vector<engine::Material> stagesOfMelting(const engine::Material& solid) {
    std::vector<engine::Material> materials = {solid};
    materials[0].repulsionReach = 1.5;
    while (materials.size() < 16) {
        engine::Material next = materials.back();
        next.repulsion *= 0.86;  // a tenth after 15 stages
        next.damping *= 0.86;
        next.repulsionReach -= 0.03;
        materials.push_back(next);
    }
    return materials;
}

/// A number from 0 to 1 for each particle, the same in every run.
double randomShare(const engine::Setup& setup, std::size_t p) {
    return 0.5 + 0.5 * engine::randomVector(setup.seed + 1, p).x();
}

/// A solid and its melt, which is softer, less damped and hardly attracts. It melts from 300 to 310 K, and conducts so
/// well that an exchange is nearly as long as an explicit one can be, as in scenes where bodies melt within seconds.
std::array<engine::Material, 2> meltable(const engine::Material& material) {
    engine::Material solid = material;
    solid.repulsionReach = 1.5;
    solid.thermal = {.capacity = 1000, .conductivity = 1000, .melting = 300, .meltingRange = 10, .latent = 1e4};
    engine::Material melt = solid;
    melt.repulsion *= 0.1;
    melt.damping *= 0.1;
    melt.repulsionReach = 1.05;
    return {solid, melt};
}

/// Makes a cube of two solids that melt, as much as the particles are high up, in air. Heat is exchanged as often as in
/// a scene with 30 frames a second.
void addHeat(engine::Setup& setup) {
    const std::vector<engine::Material> solids = powders(setup.materials.front());
    setup.heat.emplace();
    setup.heat->air = {.temperature = 290.0, .exchange = 10.0};
    setup.materials = solids;
    for (std::uint32_t solid = 0; solid < 2; ++solid) {
        const auto [cold, melt] = meltable(solids[solid]);
        setup.materials[solid] = cold;
        setup.heat->melts.push_back({solid, static_cast<std::uint32_t>(setup.materials.size()), engine::kMostStages});
        const std::vector<engine::Material> stages = stagesOf(cold, melt, engine::kMostStages);
        setup.materials.insert(setup.materials.end(), stages.begin(), stages.end());
    }
    engine::Particles& particles = setup.initial;
    const auto position = [&](std::size_t p) { return particles.position[p]; };
    const engine::BoundingBox box = engine::boundingBoxOf(particles.count(), position);
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const auto solid = static_cast<std::uint32_t>(p % 2);
        const double height = (particles.position[p].y() - box.low.y()) / std::max(1e-9, box.high.y() - box.low.y());
        const engine::Thermal& thermal = setup.materials[solid].thermal;
        // Temperatures of neighbors differ, so that some particles change their stages in an exchange.
        const double temperature = thermal.melting + thermal.meltingRange * (height + 0.02 * randomShare(setup, p));
        const double enthalpy = enthalpyAt(thermal, temperature);
        particles.enthalpy.push_back(particles.mass[p] * enthalpy);
        particles.material[p] = stageAt(*setup.heat, setup.materials, solid, enthalpy);
    }
}

}  // namespace

std::span<const Packing> packings() {
    return kPackings;
}

engine::Setup packedCube(const Packing& packing, std::size_t count) {
    engine::Setup setup = fccCube(packing.material, count, {.spacing = packing.spacing});
    const engine::Material alike = setup.materials.front();
    if (packing.differences == Differences::twoLaws) setup.materials = powders(alike);
    if (packing.differences == Differences::sixteenLaws) setup.materials = stagesOfMelting(alike);
    if (packing.differences == Differences::heat) {
        addHeat(setup);
        return setup;
    }
    engine::Particles& particles = setup.initial;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const double share = randomShare(setup, p);
        const auto materialCount = static_cast<double>(setup.materials.size());
        particles.material[p] = static_cast<std::uint32_t>(std::min(share * materialCount, materialCount - 1.0));
        if (packing.differences == Differences::radii) particles.radius[p] *= 0.8 + 0.4 * share;
    }
    return setup;
}

}  // namespace studies
