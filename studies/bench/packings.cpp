// Makes the lattices of the benchmark from a cube of particles that are alike.
#include "studies/bench/packings.h"

#include <algorithm>
#include <array>

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

}  // namespace

std::span<const Packing> packings() {
    return kPackings;
}

engine::Setup packedCube(const Packing& packing, std::size_t count) {
    engine::Setup setup = fccCube(packing.material, count, {.spacing = packing.spacing});
    const engine::Material alike = setup.materials.front();
    if (packing.differences == Differences::twoLaws) setup.materials = powders(alike);
    if (packing.differences == Differences::sixteenLaws) setup.materials = stagesOfMelting(alike);
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
