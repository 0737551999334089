// Makes a cube of particles by cutting a lattice that is slightly too large to the wanted number. See fcc_cube.h.
#include "studies/common/fcc_cube.h"

#include <cmath>

#include "engine/core/random.h"
#include "engine/forces/pair_traversal.h"
#include "engine/state/bodies.h"

namespace studies {

using engine::Vec3;

engine::Setup fccCube(const std::string& material, std::size_t count, const FccCubeShape& shape) {
    engine::Setup setup;
    setup.materials = {*engine::materialPreset(material)};
    setup.materials[0].mass = shape.mass;
    setup.gravity = Vec3::Zero();
    const double spacing = shape.spacing * 2.0 * setup.materials[0].radius;
    const double side = std::cbrt(static_cast<double>(count) / std::sqrt(2.0)) * spacing;
    // The lattice has sqrt(2) particles per cubed spacing. One spacing more makes sure that there are enough particles.
    auto positions =
        engine::boxPositions(Vec3::Zero(), Vec3::Constant(side + spacing), {.spacing = spacing, .jitter = 0.05});
    positions.resize(std::min(count, positions.size()));
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const Vec3 velocity = shape.speed * engine::randomVector(setup.seed, p);
        append(
            setup.initial,
            {.position = positions[p], .velocity = velocity, .radius = setup.materials[0].radius, .mass = shape.mass});
    }
    return setup;
}

double meanNeighbors(const engine::Setup& setup, const engine::Particles& particles) {
    const engine::ForceField field = forceFieldOf(setup);
    engine::PairTraversal pairs(field, engine::Precision::doubles);
    pairs.prepare(field, particles, particles.velocity);
    std::vector<std::uint32_t> neighbors(particles.count());
    // Several threads count at the same time, so every particle has a counter of its own.
    pairs.forEachParticle([&](std::size_t index) {
        pairs.forEachNeighbor(index, [&](std::uint32_t, const Vec3&, double) { ++neighbors[index]; });
    });
    double sum = 0.0;
    for (const std::uint32_t count : neighbors) sum += count;
    return particles.count() == 0 ? 0.0 : sum / static_cast<double>(particles.count());
}

}  // namespace studies
