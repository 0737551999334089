// Volumes spread over cubes, blurred, and added up along the axes with weights that end after six cubes.
#include "render/openness.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
glm::vec3 placeIn(const OpennessGrid& grid, glm::vec3 place) {
    return (place - grid.origin) / grid.side;
}

// at: not below zero, where whole numbers are what conversion leaves.
Trilinear cubesAround(glm::vec3 at) {
    const glm::ivec3 corner(at);
    return {corner.x, corner.y, corner.z, at - glm::vec3(corner)};
}

// Calls visit(cell, weight) for the eight cubes around a place.
template <typename Visit>
void forCorners(const OpennessGrid& grid, const Trilinear& at, const Visit& visit) {
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
OpennessGrid emptyGrid(std::span<const Sphere> particles) {
    OpennessGrid grid;
    if (particles.empty()) return grid;
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
    return grid;
}

std::vector<float> filling(const OpennessGrid& grid, std::span<const Sphere> particles) {
    std::vector<float> full(grid.cellIndex(0, 0, grid.cells.z), 0.0F);
    for (const Sphere& particle : particles) {
        const float share = particle.radius / grid.side;
        const float volume = 4.1887902F * share * share * share;
        forCorners(grid, cubesAround(placeIn(grid, particle.center)),
                   [&](std::size_t cell, float weight) { full[cell] += volume * weight; });
    }
    return full;
}

// Weights 1/4, 1/2, 1/4 along one axis; nothing lies at the border.
std::vector<float> blurred(const OpennessGrid& grid, const std::vector<float>& from, std::size_t stride) {
    std::vector<float> to(from.size(), 0.0F);
    const auto count = static_cast<std::size_t>(grid.cells.x);
    tbb::parallel_for(1, grid.cells.z - 1, [&](int z) {
        for (int y = 1; y < grid.cells.y - 1; ++y) {
            const std::size_t row = grid.cellIndex(0, y, z);
            for (std::size_t k = row + 1; k < row + count - 1; ++k)
                to[k] = 0.25F * (from[k - stride] + from[k + stride]) + 0.5F * from[k];
        }
    });
    return to;
}

// 1 / (1 + tau)^2 with tau = sum over j = 1 ... 6 of (1 - (j - 1/2)/6) F(j cubes ahead), for one row of cubes along x,
// whose values begin at `row`. open: zeros. All of it at a time, for compilers to make lanes of.
void lookAlong(const std::vector<float>& full, std::size_t row, std::ptrdiff_t stride, std::span<float> open) {
    const auto count = static_cast<std::ptrdiff_t>(open.size());
    const auto all = static_cast<std::ptrdiff_t>(full.size());
    float* out = open.data();
    for (int j = 1; j <= kReach; ++j) {
        const float weight = 1.0F - (static_cast<float>(j) - 0.5F) / static_cast<float>(kReach);
        // What leaves the grid comes in on its other side, where nothing lies either.
        const std::ptrdiff_t ahead = static_cast<std::ptrdiff_t>(row) + j * stride;
        const std::ptrdiff_t end = std::min(count, all - ahead);
        for (std::ptrdiff_t k = std::max(std::ptrdiff_t{0}, -ahead); k < end; ++k)
            out[k] += weight * full[static_cast<std::size_t>(ahead + k)];
    }
    for (std::ptrdiff_t k = 0; k < count; ++k) out[k] = 1.0F / ((1.0F + out[k]) * (1.0F + out[k]));
}

}  // namespace

OpennessGrid opennessGrid(std::span<const Sphere> particles) {
    OpennessGrid grid = emptyGrid(particles);
    if (particles.empty()) return grid;
    const auto row = static_cast<std::size_t>(grid.cells.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.cells.y);
    std::vector<float> full = filling(grid, particles);
    for (const std::size_t stride : {std::size_t{1}, row, slice}) full = blurred(grid, full, stride);
    const std::array<std::ptrdiff_t, 3> strides = {1, static_cast<std::ptrdiff_t>(row),
                                                   static_cast<std::ptrdiff_t>(slice)};
    for (std::vector<float>& values : grid.values) values.assign(full.size(), 0.0F);
    tbb::parallel_for(0, grid.cells.z, [&](int z) {
        for (int y = 0; y < grid.cells.y; ++y) {
            const std::size_t first = grid.cellIndex(0, y, z);
            for (std::size_t direction = 0; direction < 6; ++direction) {
                const std::ptrdiff_t stride = strides[direction / 2];
                lookAlong(full, first, direction % 2 == 0 ? stride : -stride,
                          std::span(grid.values[direction]).subspan(first, row));
            }
        }
    });
    return grid;
}

OpennessMap opennessAtHeight(const OpennessGrid& grid, float height) {
    OpennessMap map;
    map.side = grid.side;
    map.origin = {grid.origin.x, grid.origin.z};
    map.columns = grid.cells.x;
    map.rows = grid.cells.z;
    map.values.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), 1.0F);
    constexpr std::size_t kUp = 2;
    const float at = (height - grid.origin.y) / grid.side + kOpennessAhead;
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
