// Emission is spread over cubes, and each cube that emits lights those around it. Threads share the cubes that receive
// light by layers, and each adds up the emitters in the same order.
#include "render/prepare/lighting/glow_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "render/picture/bounds.h"

namespace render {

namespace {

constexpr int kReach = 6;                    // R of shading_model.h in sides of a cube
constexpr std::size_t kMostEmitters = 1024;  // cubes that emit: at most a million pairs of cubes then
constexpr double kMostCells = 131072.0;      // 12 MB
constexpr int kKernelSide = 2 * kReach - 1;  // offsets shorter than the reach

/// One vector of RGB for each of the six sides of a cube: +x, -x, +y, -y, +z, -z.
using SixColors = std::array<glm::vec3, 6>;

/// A cube that emits light, and its intensities along the axes.
struct Emitter {
    glm::ivec3 cell{0};
    SixColors intensity{};
};

/// Sets the place and the number of cubes of a grid around the particles, such that the kernel fits on all sides.
void fitToParticles(std::span<const Sphere> particles, GlowGrid& grid) {
    Bounds<glm::vec3> bounds;
    for (const Sphere& particle : particles) bounds.add(particle.center);
    const auto firstCell = [&](int axis) {
        return std::floor(double(bounds.low[axis]) / double(grid.side) - 0.5) - kReach;
    };
    const auto cellsAlong = [&](int axis) {
        return std::floor(double(bounds.high[axis]) / double(grid.side) - 0.5) + kReach + 2.0 - firstCell(axis);
    };
    while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > kMostCells) grid.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) {
        grid.origin[axis] = static_cast<float>((firstCell(axis) + 0.5) * double(grid.side));
        grid.cells[axis] = static_cast<int>(cellsAlong(axis));
    }
}

/// The cubes that emit light, in the order of the grid.
std::vector<Emitter> emittersOf(std::span<const Sphere> particles, float glow,
                                std::span<const std::array<float, 6>> sky, const GlowGrid& grid) {
    std::vector<SixColors> spread(grid.cellIndex(0, 0, grid.cells.z), SixColors{});
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Sphere& particle = particles[k];
        if (!(particle.radius > 0.0F)) continue;
        const glm::vec3 power = particle.color * particle.color * (glow * particle.radius * particle.radius);
        const glm::vec3 at = (particle.center - grid.origin) / grid.side;
        const glm::ivec3 corner(at);  // rounds down, because no coordinate is negative
        const glm::vec3 part = at - glm::vec3(corner);
        for (int c = 0; c < 8; ++c) {
            const glm::ivec3 step(c & 1, (c >> 1) & 1, c >> 2);
            const glm::vec3 weights = glm::mix(1.0F - part, part, glm::vec3(step));
            const glm::vec3 share = power * (weights.x * weights.y * weights.z);
            SixColors& to = spread[grid.cellIndex(corner.x + step.x, corner.y + step.y, corner.z + step.z)];
            for (std::size_t side = 0; side < 6; ++side) to[side] += share * sky[k][side];
        }
    }
    std::vector<Emitter> emitters;
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y)
            for (int x = 0; x < grid.cells.x; ++x) {
                const SixColors& found = spread[grid.cellIndex(x, y, z)];
                if (std::ranges::any_of(found,
                                        [](glm::vec3 color) { return any(greaterThan(color, glm::vec3(0.0F))); }))
                    emitters.push_back({{x, y, z}, found});
            }
    return emitters;
}

/// What the light between two cubes depends on beside the intensity: for each offset from the one that emits, the
/// squares of the components of the direction times the falloff w of shading_model.h, and their absolute values.
struct Kernel {
    struct Entry {
        glm::vec3 squares{0.0F};
        glm::vec3 cosines{0.0F};
    };
    std::array<Entry, kKernelSide * kKernelSide * kKernelSide> entries;

    explicit Kernel(float side) {
        std::size_t k = 0;
        for (int z = 1 - kReach; z < kReach; ++z)
            for (int y = 1 - kReach; y < kReach; ++y)
                for (int x = 1 - kReach; x < kReach; ++x) entries[k++] = entryAt(glm::vec3(x, y, z), side);
    }

    static Entry entryAt(glm::vec3 offset, float side) {
        const float square = dot(offset, offset);
        constexpr auto kLast = static_cast<float>(kReach * kReach);
        if (square == 0.0F || square >= kLast) return {};
        const float window = 1.0F - square / kLast;
        const float falloff = window * window / ((square + 0.25F) * side * side);
        return {offset * offset * (falloff / square), abs(offset) / std::sqrt(square)};
    }

    const Entry& at(glm::ivec3 offset) const {
        const glm::ivec3 place = offset + (kReach - 1);
        return entries[static_cast<std::size_t>(place.x + kKernelSide * (place.y + kKernelSide * place.z))];
    }
};

/// Adds the light of an emitter to one cube. @param received  the six values of the cube
void addLight(const Emitter& emitter, const Kernel::Entry& entry, glm::ivec3 offset, glm::vec4* received) {
    glm::vec3 light(0.0F);
    for (int axis = 0; axis < 3; ++axis)
        light += entry.squares[axis] * emitter.intensity[static_cast<std::size_t>(2 * axis + (offset[axis] < 0))];
    // A side receives light if it faces the emitter: +x from emitters at greater x.
    for (int axis = 0; axis < 3; ++axis)
        received[2 * axis + (offset[axis] > 0)] += glm::vec4(entry.cosines[axis] * light, 0.0F);
}

/// Adds the light of all emitters to one layer of cubes.
void lightLayer(std::span<const Emitter> emitters, const Kernel& kernel, int z, GlowGrid& grid) {
    for (const Emitter& emitter : emitters) {
        if (std::abs(z - emitter.cell.z) >= kReach) continue;
        for (int y = 1 - kReach; y < kReach; ++y)
            for (int x = 1 - kReach; x < kReach; ++x) {
                const glm::ivec3 offset(x, y, z - emitter.cell.z);
                const Kernel::Entry& entry = kernel.at(offset);
                if (entry.squares == glm::vec3(0.0F)) continue;
                const std::size_t cell = grid.cellIndex(emitter.cell.x + x, emitter.cell.y + y, z);
                addLight(emitter, entry, offset, &grid.values[6 * cell]);
            }
    }
}

}  // namespace

GlowGrid glowGrid(std::span<const Sphere> particles, float glow, std::span<const std::array<float, 6>> sky,
                  float skySide) {
    GlowGrid grid;
    if (particles.empty() || !(glow > 0.0F)) return grid;
    grid.side = 2.0F * skySide;
    fitToParticles(particles, grid);
    std::vector<Emitter> emitters = emittersOf(particles, glow, sky, grid);
    while (emitters.size() > kMostEmitters) {
        grid.side *= 2.0F;
        fitToParticles(particles, grid);
        emitters = emittersOf(particles, glow, sky, grid);
    }
    if (emitters.empty()) return grid;
    grid.values.assign(6 * grid.cellIndex(0, 0, grid.cells.z), glm::vec4(0.0F));
    const Kernel kernel(grid.side);
    tbb::parallel_for(0, grid.cells.z, [&](int z) { lightLayer(emitters, kernel, z, grid); });
    return grid;
}

}  // namespace render
