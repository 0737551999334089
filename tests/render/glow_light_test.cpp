// The light of glowing particles on the grid against the sum over all particles that it stands for.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/global_control.h>

#include "render/prepare/lighting/ambient_occlusion.h"
#include "render/prepare/lighting/glow_light.h"
#include "tests/render/pictures.h"

using namespace pictures;

namespace {

/// A heap of particles that glow in several colors, and their sky visibility.
struct Heap {
    std::vector<render::Sphere> particles;
    render::SkyVisibilityGrid skyGrid;
    std::vector<render::SkyVisibility> sky;

    explicit Heap(int side) {
        for (int k = 0; k < side * side * side; ++k) {
            const glm::vec3 shake(std::sin(12.9F * float(k)), std::sin(7.3F * float(k)), std::sin(3.1F * float(k)));
            const glm::vec3 at(k % side, k / side % side, k / side / side);
            particles.push_back({0.18F * at + 0.03F * shake, 0.1F, {0.9F, 0.4F + 0.1F * shake.x, 0.1F}});
        }
        skyGrid = render::skyVisibilityGrid(particles);
        sky = render::particleSkyVisibility(particles, skyGrid);
    }

    render::GlowGrid grid() const { return render::glowGrid(particles, 2.0F, sky, skyGrid.side); }

    /// The irradiance of a surface that faces along an axis, particle by particle.
    glm::dvec3 sumAt(glm::vec3 point, glm::dvec3 facing, double side) const {
        glm::dvec3 sum(0.0);
        for (std::size_t k = 0; k < particles.size(); ++k) {
            const glm::dvec3 offset = glm::dvec3(point) - glm::dvec3(particles[k].center);
            const double distance = glm::length(offset);
            const glm::dvec3 u = offset / distance;
            if (distance >= 6.0 * side) continue;
            double open = 0.0;
            for (int axis = 0; axis < 3; ++axis)
                open +=
                    u[axis] * u[axis] * double(sky[k][static_cast<std::size_t>(2 * axis + (u[axis] > 0.0 ? 0 : 1))]);
            const double radius = double(particles[k].radius);
            const double window = 1.0 - distance * distance / (36.0 * side * side);
            const glm::dvec3 albedo(particles[k].color);
            sum += 2.0 * albedo * albedo *
                   (radius * radius * open * std::max(0.0, -glm::dot(u, facing)) * window * window /
                    (distance * distance + 0.25 * side * side));
        }
        return sum;
    }
};

}  // namespace

TEST_CASE("The light of particles is the sum over all of them") {
    const Heap heap(10);
    const render::GlowGrid grid = heap.grid();
    REQUIRE_FALSE(grid.empty());
    double most = 0.0;
    double worst = 0.0;
    int lit = 0;
    std::size_t cell = 0;
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y)
            for (int x = 0; x < grid.cells.x; ++x, ++cell) {
                const glm::vec3 at = grid.origin + grid.side * glm::vec3(x, y, z);
                // Nearer than two cubes, the cubes are no particles any more.
                const bool isNear = std::ranges::any_of(heap.particles, [&](const render::Sphere& particle) {
                    return glm::distance(particle.center, at) < 2.0F * grid.side;
                });
                if (isNear) continue;
                for (int side = 0; side < 6; ++side) {
                    glm::dvec3 facing(0.0);
                    facing[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
                    const glm::dvec3 exact = heap.sumAt(at, facing, double(grid.side));
                    const glm::dvec3 found(grid.values[6 * cell + static_cast<std::size_t>(side)]);
                    most = std::max(most, exact.x);
                    worst = std::max(worst, glm::length(found - exact));
                    lit += exact.x > 0.0 ? 1 : 0;
                }
            }
    CAPTURE(grid.side, most, worst, lit);
    CHECK(lit > 1000);
    // Spread over cubes, light comes from up to a cube's side beside its particle, at two cubes' distance and more.
    CHECK(worst < 0.1 * most);
}

TEST_CASE("The light of particles ends at the border of its grid and behind what glows there is none") {
    const Heap heap(6);
    const render::GlowGrid grid = heap.grid();
    const auto valueAt = [&](glm::ivec3 cell, std::size_t side) {
        return grid.values[6 * grid.cellIndex(cell.x, cell.y, cell.z) + side].x;
    };
    for (int y = 0; y < grid.cells.y; ++y)
        for (int z = 0; z < grid.cells.z; ++z)
            for (std::size_t side = 0; side < 6; ++side) {
                REQUIRE(valueAt({0, y, z}, side) == 0.0F);
                REQUIRE(valueAt({grid.cells.x - 1, y, z}, side) == 0.0F);
            }
    const glm::ivec3 middle = grid.cells / 2;
    CHECK(valueAt({2, middle.y, middle.z}, 0) > 0.0F);   // left of the heap: on what faces right,
    CHECK(valueAt({2, middle.y, middle.z}, 1) == 0.0F);  // but not on what faces left
}

TEST_CASE("Threads do not change the light of particles, and a large heap takes wider cubes") {
    const Heap heap(30);
    std::vector<glm::vec4> first;
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const render::GlowGrid grid = heap.grid();
        CHECK(grid.side > 2.5F * heap.skyGrid.side);  // 30^3 particles, 0.18 m apart, are in more than 1024 cubes
        if (first.empty()) first = grid.values;
        CHECK(grid.values == first);
    }
    CHECK(render::glowGrid(heap.particles, 0.0F, heap.sky, heap.skyGrid.side).empty());
    CHECK(render::glowGrid({}, 1.0F, {}, 1.0F).empty());
}
