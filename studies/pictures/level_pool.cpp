// The jitter is a sequence without random numbers, so that the pool is the same on every machine.
#include "studies/pictures/level_pool.h"

#include <cmath>
#include <numbers>

namespace studies {

constexpr int kPoolSide = 24;  // number of particles along each horizontal side
constexpr int kPoolDepth = 6;  // number of layers of particles

render::View levelPool(const render::View& appearance) {
    constexpr double kJitter = 0.12;  // lattice spacings; chosen: as in dam_break_view.cpp
    render::View view = appearance;
    view.particles.clear();
    view.ground.reset();
    view.camera.projection = render::Projection::orthographic;
    view.camera.eye = {0.0F, 10.0F, 0.0F};
    view.camera.up = {0.0F, 0.0F, -1.0F};
    view.camera.target = glm::vec3(0.0F);
    view.camera.halfHeight = 3.0F;
    // Multiples of irrational numbers modulo 1 are spread evenly and do not repeat with the lattice.
    const auto jitter = [](int k, double by) { return kJitter * (2.0 * (k * by - std::floor(k * by)) - 1.0); };
    for (int k = 0; k < kPoolSide * kPoolSide * kPoolDepth; ++k) {
        const glm::dvec3 lattice(k % kPoolSide - 0.5 * kPoolSide, -(k / kPoolSide / kPoolSide),
                                 k / kPoolSide % kPoolSide - 0.5 * kPoolSide);
        const glm::dvec3 off(jitter(k, std::numbers::sqrt2), jitter(k, std::numbers::sqrt3),
                             jitter(k, std::numbers::pi));
        view.particles.push_back({glm::vec3(lattice + off), 0.658F, glm::vec3(0.8F)});
    }
    return view;
}

}  // namespace studies
