// Volumes spread over cubes, blurred, and added up along the axes with weights that end after six cubes.
#include "render/prepare/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

namespace render {

namespace {

constexpr int kReach = 6;  // cubes
// Cubes around the particles: one for the spread, one for the blur, the reach, and one for the places between.
constexpr int kMargin = kReach + 4;
// 24 MB of values; wider cubes beyond, for the sake of a drop that flies far.
constexpr double kMostCells = 1e6;

float sideOf(std::span<const Sphere> particles) {
    double sum = 0.0;
    for (const Sphere& particle : particles) sum += double(particle.radius);
    const double wanted = 2.0 * sum / static_cast<double>(particles.size());
    constexpr double kStep = 1.189207115002721;  // 2^(1/4)
    double side = 1.0;
    while (side < wanted) side *= kStep;
    while (side / kStep >= wanted && side > 1e-6) side /= kStep;
    return static_cast<float>(side);
}

struct Trilinear {
    int x = 0, y = 0, z = 0;
    glm::vec3 part{0.0F};
};

// In sides of a cube, from the middle of the first.
glm::vec3 placeIn(const SkyVisibilityGrid& grid, glm::vec3 place) {
    return (place - grid.origin) / grid.side;
}

// at: not below zero, where whole numbers are what conversion leaves.
Trilinear cubesAround(glm::vec3 at) {
    const glm::ivec3 corner(at);
    return {corner.x, corner.y, corner.z, at - glm::vec3(corner)};
}

// Calls visit(cell, weight) for the eight cubes around a place.
template <typename Visit>
void forCorners(const SkyVisibilityGrid& grid, const Trilinear& at, const Visit& visit) {
    const std::size_t first = grid.cellIndex(at.x, at.y, at.z);
    const auto row = static_cast<std::size_t>(grid.cells.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.cells.y);
    const float x1 = at.part.x;
    const float x0 = 1.0F - x1;
    for (std::size_t z = 0; z < 2; ++z) {
        const float wz = z == 0 ? 1.0F - at.part.z : at.part.z;
        for (std::size_t y = 0; y < 2; ++y) {
            const float w = wz * (y == 0 ? 1.0F - at.part.y : at.part.y);
            const std::size_t cell = first + z * slice + y * row;
            visit(cell, w * x0);
            visit(cell + 1, w * x1);
        }
    }
}

// Size and place of a grid around the particles, its corners at multiples of the side.
void fitTo(std::span<const Sphere> particles, SkyVisibilityGrid& grid) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const Sphere& particle : particles) {
        low = min(low, particle.center);
        high = max(high, particle.center);
    }
    grid.side = sideOf(particles);
    const auto cellsAlong = [&](int axis) {
        return std::floor(double(high[axis]) / double(grid.side)) - std::floor(double(low[axis]) / double(grid.side)) +
               2.0 * kMargin + 1.0;
    };
    while (cellsAlong(0) * cellsAlong(1) * cellsAlong(2) > kMostCells) grid.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const double first = std::floor(double(low[axis]) / double(grid.side)) - kMargin;
        grid.origin[axis] = static_cast<float>((first + 0.5) * double(grid.side));
        grid.cells[axis] = static_cast<int>(cellsAlong(axis));
    }
}

// Values of all cubes between two margins of zeros, so that looks may leave the grid.
struct Filling {
    std::size_t margin = 0;
    std::vector<float> values;

    explicit Filling(const SkyVisibilityGrid& grid)
        : margin(grid.cellIndex(0, 0, kReach)), values(grid.cellIndex(0, 0, grid.cells.z) + 2 * margin, 0.0F) {}

    float* at(std::size_t cell) { return &values[margin + cell]; }
    const float* at(std::size_t cell) const { return &values[margin + cell]; }
};

Filling filling(const SkyVisibilityGrid& grid, std::span<const Sphere> particles) {
    Filling full(grid);
    for (const Sphere& particle : particles) {
        const float share = particle.radius / grid.side;
        const float volume = 4.1887902F * share * share * share;
        forCorners(grid, cubesAround(placeIn(grid, particle.center)),
                   [&](std::size_t cell, float weight) { *full.at(cell) += volume * weight; });
    }
    return full;
}

// Weights 1/4, 1/2, 1/4 along one axis; nothing lies at the border.
void blur(const SkyVisibilityGrid& grid, std::ptrdiff_t stride, const Filling& from, Filling& to) {
    const std::ptrdiff_t count = grid.cells.x;
    tbb::parallel_for(1, grid.cells.z - 1, [&](int z) {
        for (int y = 1; y < grid.cells.y - 1; ++y) {
            const float* in = from.at(grid.cellIndex(0, y, z));
            float* out = to.at(grid.cellIndex(0, y, z));
            for (std::ptrdiff_t k = 1; k < count - 1; ++k)
                out[k] = 0.25F * (in[k - stride] + in[k + stride]) + 0.5F * in[k];
        }
    });
}

// 1 / (1 + tau)^2 with tau = sum over j = 1 ... 6 of (1 - (j - 1/2)/6) F(j cubes ahead), for one row of cubes along x,
// whose fillings begin at `full`. What leaves a row comes in on the other side of another, where nothing lies either.
void lookAlong(const float* full, std::ptrdiff_t stride, std::span<float> open) {
    constexpr auto weight = [](int j) { return 1.0F - (static_cast<float>(j) - 0.5F) / static_cast<float>(kReach); };
    const auto count = static_cast<std::ptrdiff_t>(open.size());
    float* out = open.data();
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        float tau = 0.0F;
        for (int j = 1; j <= kReach; ++j) tau += weight(j) * full[k + j * stride];
        out[k] = 1.0F / ((1.0F + tau) * (1.0F + tau));
    }
}

}  // namespace

SkyVisibilityGrid skyVisibilityGrid(std::span<const Sphere> particles, SkyVisibilityGrid old) {
    if (particles.empty()) return {};
    SkyVisibilityGrid grid = std::move(old);
    fitTo(particles, grid);
    const auto row = static_cast<std::size_t>(grid.cells.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.cells.y);
    const std::array<std::ptrdiff_t, 3> strides = {1, static_cast<std::ptrdiff_t>(row),
                                                   static_cast<std::ptrdiff_t>(slice)};
    Filling full = filling(grid, particles);
    Filling other(grid);
    for (const std::ptrdiff_t stride : strides) {
        blur(grid, stride, full, other);
        std::swap(full, other);
    }
    for (std::vector<float>& values : grid.values) values.resize(grid.cellIndex(0, 0, grid.cells.z));
    tbb::parallel_for(0, grid.cells.z, [&](int z) {
        for (int y = 0; y < grid.cells.y; ++y) {
            const std::size_t first = grid.cellIndex(0, y, z);
            for (std::size_t direction = 0; direction < 6; ++direction) {
                const std::ptrdiff_t stride = strides[direction / 2];
                lookAlong(full.at(first), direction % 2 == 0 ? stride : -stride,
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
    constexpr std::size_t kUp = 2;
    const float at = (height - grid.origin.y) / grid.side + kSkySampleOffset;
    const float floor = std::floor(at);
    const int y = static_cast<int>(std::clamp(floor, -2.0F, 1e6F));
    if (grid.cells.x == 0 || y < 0 || y + 1 >= grid.cells.y) return map;
    const float part = at - floor;
    std::size_t place = 0;
    for (int z = 0; z < map.rows; ++z)
        for (int x = 0; x < map.columns; ++x)
            map.values[place++] = (1.0F - part) * grid.values[kUp][grid.cellIndex(x, y, z)] +
                                  part * grid.values[kUp][grid.cellIndex(x, y + 1, z)];
    return map;
}

}  // namespace render
