// The particles' volumes are spread over cubes, blurred, and summed up along the axes. The values at the particles are
// then interpolated with as many particles at a time as a vector has lanes: this file is compiled once per instruction
// set.
#include "render/prepare/lighting/ambient_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/prepare/cells/mean_radius.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/lighting/ambient_occlusion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/lighting/simd_occlusion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Computes the sky visibility at particles' centers, a vector of particles at a time.
void skyVisibilityOfBatch(const SkyVisibilityGrid& grid, std::span<const Sphere> particles,
                          std::span<SkyVisibility> found) {
    const D d;
    using Values = std::array<float, kTileSize>;  // room for the widest vector
    for (std::size_t first = 0; first < particles.size(); first += hn::Lanes(d)) {
        const std::size_t count = std::min(hn::Lanes(d), particles.size() - first);
        alignas(64) std::array<Values, 3> center{};
        for (std::size_t lane = 0; lane < count; ++lane)
            for (std::size_t axis = 0; axis < 3; ++axis)
                center[axis][lane] = particles[first + lane].center[static_cast<int>(axis)];
        const Vec3 at =
            gridPosition(grid, glm::vec3(0.0F),
                         {hn::Load(d, center[0].data()), hn::Load(d, center[1].data()), hn::Load(d, center[2].data())});
        alignas(64) std::array<Values, 6> values;
        for (std::size_t side = 0; side < 6; ++side)
            hn::Store(skyVisibilityInGrid(grid, side, at), d, values[side].data());
        for (std::size_t lane = 0; lane < count; ++lane)
            for (std::size_t side = 0; side < 6; ++side) found[first + lane][side] = values[side][lane];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(skyVisibilityOfBatch);

namespace {

constexpr int kReach = 6;  // number of cubes that the sum tau of shading_model.h takes in
// Cubes between the particles and the sides of the grid: the reach, one that volumes are spread over, one more for the
// blur, and two for the interpolation at points that are offset along a direction.
constexpr int kMargin = kReach + 4;
// Largest number of cubes: with six values each, they take 24 MB. Where particles lie too far apart for it, the cubes
// become wider instead.
constexpr double kMostCells = 1e6;

/// The side s of the cubes of shading_model.h, before it is doubled.
float cubeSide(std::span<const Sphere> particles) {
    const double wanted = 2.0 * meanRadius(particles);
    if (!(wanted > 0.0)) return 1.0F;
    // Powers of 2^(1/4) from 1/2 to 1: those around the mantissa that std::frexp() returns.
    constexpr std::array<double, 5> kPowers = {0.5, 0.5946035575013605, 0.7071067811865476, 0.8408964152537145, 1.0};
    int exponent = 0;
    const double mantissa = std::frexp(wanted, &exponent);
    return static_cast<float>(std::ldexp(*std::ranges::lower_bound(kPowers, mantissa), exponent));
}

/// Calls visit(cell index, trilinear weight) for the eight cubes whose centers surround a point within the grid.
template <typename Visit>
void forSurroundingCells(const SkyVisibilityGrid& grid, glm::vec3 point, const Visit& visit) {
    const glm::vec3 at = (point - grid.origin) / grid.side;
    const glm::ivec3 corner(at);  // rounds down, because no coordinate is negative
    const glm::vec3 part = at - glm::vec3(corner);
    const std::size_t first = cellIndex(grid.cells, corner.x, corner.y, corner.z);
    const auto row = static_cast<std::size_t>(grid.cells.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.cells.y);
    const float x1 = part.x;
    const float x0 = 1.0F - x1;
    for (std::size_t z = 0; z < 2; ++z) {
        const float wz = z == 0 ? 1.0F - part.z : part.z;
        for (std::size_t y = 0; y < 2; ++y) {
            const float w = wz * (y == 0 ? 1.0F - part.y : part.y);
            const std::size_t cell = first + z * slice + y * row;
            visit(cell, w * x0);
            visit(cell + 1, w * x1);
        }
    }
}

/// Sets the origin, side and number of cubes of a grid around the particles.
void fitToParticles(std::span<const Sphere> particles, SkyVisibilityGrid& grid) {
    Bounds<glm::vec3> bounds;
    for (const Sphere& particle : particles) bounds.add(particle.center);
    grid.side = cubeSide(particles);
    const auto cellsAlong = [&](int axis) {
        return std::floor(double(bounds.high[axis]) / double(grid.side)) -
               std::floor(double(bounds.low[axis]) / double(grid.side)) + 2.0 * kMargin + 1.0;
    };
    while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > kMostCells) grid.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const double first = std::floor(double(bounds.low[axis]) / double(grid.side)) - kMargin;
        grid.origin[axis] = static_cast<float>((first + 0.5) * double(grid.side));
        grid.cells[axis] = static_cast<int>(cellsAlong(axis));
    }
}

/// One value for each cube of a grid, between two margins of zeros, so that sums along an axis may leave the grid.
struct CubeValues {
    std::size_t margin = 0;
    std::vector<float> values;

    explicit CubeValues(const SkyVisibilityGrid& grid)
        : margin(cellIndex(grid.cells, 0, 0, kReach)),
          values(cellIndex(grid.cells, 0, 0, grid.cells.z) + 2 * margin, 0.0F) {}

    float* at(std::size_t cell) { return &values[margin + cell]; }
    const float* at(std::size_t cell) const { return &values[margin + cell]; }
};

/// The particles' volumes, spread over the cubes, in units of s^3.
CubeValues spreadVolumes(const SkyVisibilityGrid& grid, std::span<const Sphere> particles) {
    CubeValues density(grid);
    for (const Sphere& particle : particles) {
        const float radius = particle.radius / grid.side;
        const float volume = 4.1887902F * radius * radius * radius;  // 4/3 pi r^3
        forSurroundingCells(grid, particle.center,
                            [&](std::size_t cell, float weight) { *density.at(cell) += volume * weight; });
    }
    return density;
}

/// Applies the weights 1/4, 1/2, 1/4 along one axis. The outermost cubes are empty and stay so.
/// @param stride  difference in index between neighboring cubes along the axis
void blur(const SkyVisibilityGrid& grid, std::ptrdiff_t stride, const CubeValues& from, CubeValues& to) {
    const std::ptrdiff_t count = grid.cells.x;
    tbb::parallel_for(1, grid.cells.z - 1, [&](int z) {
        for (int y = 1; y < grid.cells.y - 1; ++y) {
            const float* in = from.at(cellIndex(grid.cells, 0, y, z));
            float* out = to.at(cellIndex(grid.cells, 0, y, z));
            for (std::ptrdiff_t k = 1; k < count - 1; ++k)
                out[k] = 0.25F * (in[k - stride] + in[k + stride]) + 0.5F * in[k];
        }
    });
}

/// O = 1/(1 + tau)^2 of shading_model.h toward one side, for a row of cubes along x whose densities begin at `density`.
/// A sum that leaves the row goes on at the end of a neighboring row, where all cubes are empty as well.
/// @param stride  difference in index to the next cube toward that side
void integrateAlong(const float* density, std::ptrdiff_t stride, std::span<float> visibility) {
    constexpr auto weight = [](int j) { return 1.0F - (static_cast<float>(j) - 0.5F) / static_cast<float>(kReach); };
    const auto count = static_cast<std::ptrdiff_t>(visibility.size());
    float* out = visibility.data();
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        float tau = 0.0F;
        for (int j = 1; j <= kReach; ++j) tau += weight(j) * density[k + j * stride];
        out[k] = 1.0F / ((1.0F + tau) * (1.0F + tau));
    }
}

}  // namespace

SkyVisibilityGrid skyVisibilityGrid(std::span<const Sphere> particles, SkyVisibilityGrid old) {
    if (particles.empty()) return {};
    SkyVisibilityGrid grid = std::move(old);
    fitToParticles(particles, grid);
    const auto row = static_cast<std::size_t>(grid.cells.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.cells.y);
    const std::array<std::ptrdiff_t, 3> strides = {1, static_cast<std::ptrdiff_t>(row),
                                                   static_cast<std::ptrdiff_t>(slice)};
    CubeValues density = spreadVolumes(grid, particles);
    CubeValues blurred(grid);
    for (const std::ptrdiff_t stride : strides) {
        blur(grid, stride, density, blurred);
        std::swap(density, blurred);
    }
    for (std::vector<float>& values : grid.values) values.resize(cellIndex(grid.cells, 0, 0, grid.cells.z));
    tbb::parallel_for(0, grid.cells.z, [&](int z) {
        for (int y = 0; y < grid.cells.y; ++y) {
            const std::size_t first = cellIndex(grid.cells, 0, y, z);
            for (std::size_t direction = 0; direction < 6; ++direction) {
                const std::ptrdiff_t stride = strides[direction / 2];
                integrateAlong(density.at(first), direction % 2 == 0 ? stride : -stride,
                               std::span(grid.values[direction]).subspan(first, row));
            }
        }
    });
    return grid;
}

SkyVisibilityMap skyVisibilityAtHeight(const SkyVisibilityGrid& grid, float height) {
    SkyVisibilityMap map;
    map.side = grid.side;
    map.origin = {grid.origin.x, grid.origin.z};
    map.columns = grid.cells.x;
    map.rows = grid.cells.z;
    map.values.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), 1.0F);
    constexpr std::size_t kUp = 2;  // +y in the order of SkyVisibility
    const float at = (height - grid.origin.y) / grid.side + kSkySampleOffset;
    const float floor = std::floor(at);
    const int y = static_cast<int>(std::clamp(floor, -2.0F, 1e6F));
    if (grid.cells.x == 0 || y < 0 || y + 1 >= grid.cells.y) return map;
    const float part = at - floor;
    std::size_t cell = 0;
    for (int z = 0; z < map.rows; ++z)
        for (int x = 0; x < map.columns; ++x)
            map.values[cell++] = (1.0F - part) * grid.values[kUp][cellIndex(grid.cells, x, y, z)] +
                                 part * grid.values[kUp][cellIndex(grid.cells, x, y + 1, z)];
    return map;
}

std::vector<SkyVisibility> particleSkyVisibility(std::span<const Sphere> particles, const SkyVisibilityGrid& grid) {
    std::vector<SkyVisibility> found(particles.size(), kUnoccluded);
    if (grid.cells.x == 0) return found;
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.size(), kChunk), [&](const auto& range) {
        HWY_DYNAMIC_DISPATCH(skyVisibilityOfBatch)
        (grid, particles.subspan(range.begin(), range.size()), std::span(found).subspan(range.begin(), range.size()));
    });
    return found;
}

}  // namespace render

#endif
