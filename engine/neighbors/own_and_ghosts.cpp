// Fetches ghosts from their ranks.
#include "engine/neighbors/own_and_ghosts.h"

#include "engine/core/parallel.h"

namespace engine {
namespace {

/// What does not change in a particle's life.
struct Fixed {
    double radius = 0.0;
    double mass = 0.0;
    std::uint32_t material = 0;
};

/// What changes in every step; sent in one message.
struct Moving {
    Vec3 position;
    Vec3 velocity;
};

}  // namespace

void findGhosts(const Ranks& ranks, const Particles& own, const std::vector<Vec3>& positions, double reach,
                OwnAndGhosts& all) {
    const std::size_t count = positions.size();
    all.halo = findHalo(ranks, positions, std::span(own.id).first(count), reach);
    std::vector<Fixed> ownFixed;
    std::vector<Fixed> fixed;
    for (std::size_t p = 0; p < count; ++p) ownFixed.push_back({own.radius[p], own.mass[p], own.material[p]});
    share(ranks, all.halo, ownFixed, fixed);
    Particles& particles = all.particles;
    particles.id = all.halo.ids;
    particles.radius.clear();
    particles.mass.clear();
    particles.material.clear();
    for (const Fixed& of : fixed) {
        particles.radius.push_back(of.radius);
        particles.mass.push_back(of.mass);
        particles.material.push_back(of.material);
    }
    share(ranks, all.halo, positions, particles.position);
}

void fetchGhosts(const Ranks& ranks, const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities,
                 OwnAndGhosts& all) {
    const Halo& halo = all.halo;
    const auto received = swapItems<Moving>(
        ranks, halo.routes,
        [&](std::uint32_t p) -> Moving {
            return {positions[p], velocities[p]};
        },
        ghostCounts(halo));
    all.velocities.resize(halo.ids.size());
    inParallel(halo.combinedIndexOf.size(), kParticleGrain, [&](std::size_t p) {
        all.particles.position[halo.combinedIndexOf[p]] = positions[p];
        all.velocities[halo.combinedIndexOf[p]] = velocities[p];
    });
    for (std::size_t k = 0; k < halo.routes.size(); ++k)
        for (std::size_t g = 0; g < received[k].size(); ++g) {
            all.particles.position[halo.routes[k].ghosts[g]] = received[k][g].position;
            all.velocities[halo.routes[k].ghosts[g]] = received[k][g].velocity;
        }
}

}  // namespace engine
