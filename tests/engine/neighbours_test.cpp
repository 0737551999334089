// The cell grid finds every pair within its width exactly once, wherever the particles are.
#include "engine/neighbours.h"

#include <algorithm>
#include <limits>
#include <set>
#include "tests/catch.h"

#include "tests/engine/clouds.h"

using namespace engine;

namespace {

/// Every particle that the grid offers as a candidate for p; fails on one that is offered twice.
std::set<std::uint32_t> candidates(const CellGrid& grid, std::size_t p) {
    std::set<std::uint32_t> found;
    const Neighbourhood around = neighbourhood(grid, grid.cellOf[p]);
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        for (std::uint32_t slot = range.begin; slot < range.end; ++slot) CHECK(found.insert(grid.order[slot]).second);
    }
    return found;
}

void checkComplete(const std::vector<Vec3>& positions, double width) {
    CellGrid grid;
    build(grid, positions, width);
    CHECK(grid.cellCount() <= std::max<std::size_t>(64, 2 * positions.size()));
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const auto found = candidates(grid, p);
        for (std::uint32_t i = 0; i < positions.size(); ++i)
            if (squaredLength(positions[p] - positions[i]) < width * width) {
                INFO("particle " << p << " misses " << i);
                CHECK(found.count(i) == 1);
            }
    }
}

}  // namespace

TEST_CASE("Every pair within the width is found once", "[neighbours]") {
    checkComplete(clouds::strewn(300, 1.5).position, 0.6);   // dense
    checkComplete(clouds::strewn(300, 6.0).position, 0.6);   // more cells wanted than allowed
    checkComplete(clouds::strewn(50, 0.2).position, 0.6);    // all in one or two cells
    checkComplete(clouds::strewn(200, 40.0).position, 0.6);  // thin
}

TEST_CASE("Flat and linear arrangements have fewer than three cells across", "[neighbours]") {
    std::vector<Vec3> flat = clouds::strewn(200, 3.0).position;
    for (Vec3& position : flat) position.z() = 0.0;
    checkComplete(flat, 0.6);
    for (Vec3& position : flat) position.y() = 0.0;
    checkComplete(flat, 0.6);
}

TEST_CASE("Particles on cell faces and far outliers are found", "[neighbours]") {
    std::vector<Vec3> positions;
    for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y) positions.emplace_back(0.6 * x, 0.6 * y, 0.0);
    positions.emplace_back(1e7, 0.0, 0.0);
    positions.emplace_back(1e7 + 0.1, 0.0, 0.0);
    positions.emplace_back(-1e7, 9e6, -5e6);
    checkComplete(positions, 0.6);
}

TEST_CASE("The order within a cell is that of the indices", "[neighbours]") {
    CellGrid grid;
    build(grid, clouds::strewn(500, 1.0).position, 0.5);
    for (std::size_t cell = 0; cell < grid.cellCount(); ++cell)
        CHECK(std::is_sorted(grid.order.begin() + grid.start[cell], grid.order.begin() + grid.start[cell + 1]));
}

TEST_CASE("No particles, no cells to visit", "[neighbours]") {
    CellGrid grid;
    build(grid, {}, 0.6);
    CHECK(grid.order.empty());
    CHECK(neighbourhood(grid, 0).count == 0);
}

TEST_CASE("Positions that are no numbers or beyond all cells do no harm to the others", "[neighbours]") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec3> positions = clouds::strewn(100, 3.0).position;
    const std::size_t sound = positions.size();
    positions.emplace_back(1e300, 0.0, -1e300);
    positions.emplace_back(kNan, 0.0, 0.0);
    CellGrid grid;
    build(grid, positions, 0.6);
    for (std::size_t p = 0; p < sound; ++p) {
        const auto found = candidates(grid, p);
        for (std::uint32_t i = 0; i < sound; ++i)
            if (squaredLength(positions[p] - positions[i]) < 0.36) CHECK(found.count(i) == 1);
    }
}
