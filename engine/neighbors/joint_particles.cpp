// Fetches ghosts from their ranks.
#include "engine/neighbors/joint_particles.h"

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
                JointParticles& joint) {
    const std::size_t count = positions.size();
    joint.halo = findHalo(ranks, positions, std::span(own.id).first(count), reach);
    std::vector<Fixed> ownFixed;
    std::vector<Fixed> fixed;
    for (std::size_t p = 0; p < count; ++p) ownFixed.push_back({own.radius[p], own.mass[p], own.material[p]});
    share(ranks, joint.halo, ownFixed, fixed);
    Particles& particles = joint.particles;
    particles.id = joint.halo.ids;
    particles.radius.clear();
    particles.mass.clear();
    particles.material.clear();
    for (const Fixed& of : fixed) {
        particles.radius.push_back(of.radius);
        particles.mass.push_back(of.mass);
        particles.material.push_back(of.material);
    }
    share(ranks, joint.halo, positions, particles.position);
}

void fetchGhosts(const Ranks& ranks, const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities,
                 JointParticles& joint) {
    std::vector<Moving> own(positions.size());
    inParallel(own.size(), kParticleGrain, [&](std::size_t p) { own[p] = {positions[p], velocities[p]}; });
    std::vector<Moving> moving;
    share(ranks, joint.halo, own, moving);
    joint.particles.position.resize(moving.size());
    joint.velocities.resize(moving.size());
    inParallel(moving.size(), kParticleGrain, [&](std::size_t j) {
        joint.particles.position[j] = moving[j].position;
        joint.velocities[j] = moving[j].velocity;
    });
}

}  // namespace engine
