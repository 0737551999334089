// The cell grid finds every pair within its width exactly once, wherever the particles are.
#include "engine/neighbors/cell_grid.h"

#include <algorithm>
#include <limits>
#include <set>
#include "tests/catch.h"

#include "tests/engine/clouds.h"
#include "tests/engine/on_instruction_set.h"

using namespace engine;

namespace {

/// Every particle that the grid has in or around a run; fails on one that occurs twice.
std::set<std::uint32_t> candidates(const CellGrid& grid, const CellRun& run) {
    std::set<std::uint32_t> found;
    const Neighborhood around = neighborhood(grid, run);
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        for (std::uint32_t slot = range.begin; slot < range.end; ++slot) CHECK(found.insert(grid.order[slot]).second);
    }
    return found;
}

void checkOffered(const std::vector<Vec3>& positions, double width, std::size_t p,
                  const std::set<std::uint32_t>& found) {
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (squaredLength(positions[p] - positions[i]) < width * width) {
            INFO("particle " << p << " misses " << i);
            CHECK(found.count(i) == 1);
        }
}

constexpr std::uint32_t kMostParticles = 12;
constexpr std::uint32_t kMostCells = 5;

void checkComplete(const std::vector<Vec3>& positions, double width) {
    CellGrid grid;
    build(grid, positions, width);
    CHECK(grid.cellCount() <= std::max<std::size_t>(64, 2 * positions.size()));
    for (std::size_t p = 0; p < positions.size(); ++p)
        checkOffered(positions, width, p, candidates(grid, {grid.cellOf[p], grid.cellOf[p]}));
    for (std::uint32_t sortedIndex = 0; sortedIndex < positions.size(); ++sortedIndex)
        CHECK(cellOfSortedIndex(grid, sortedIndex) == grid.cellOf[grid.order[sortedIndex]]);
    for (std::uint32_t cell = 0; cell < grid.cellCount(); ++cell) {
        const CellRun run = runFrom(grid, cell, kMostParticles, kMostCells);
        CHECK(run.first == cell);
        CHECK(run.last < cell + kMostCells);
        if (run.last > cell) CHECK(grid.start[run.last + 1] - grid.start[cell] <= kMostParticles);
        const auto found = candidates(grid, run);
        for (std::uint32_t slot = grid.start[cell]; slot < grid.start[run.last + 1]; ++slot)
            checkOffered(positions, width, grid.order[slot], found);
    }
}

}  // namespace

TEST_CASE("Every pair within the width is found once", "[cell-grid]") {
    checkComplete(clouds::strewn(300, 1.5).position, 0.6);   // dense
    checkComplete(clouds::strewn(300, 6.0).position, 0.6);   // more cells needed than allowed
    checkComplete(clouds::strewn(50, 0.2).position, 0.6);    // all in one or two cells
    checkComplete(clouds::strewn(200, 40.0).position, 0.6);  // thinly spread
}

TEST_CASE("Flat and linear arrangements have fewer than three cells across", "[cell-grid]") {
    std::vector<Vec3> flat = clouds::strewn(200, 3.0).position;
    for (Vec3& position : flat) position.z() = 0.0;
    checkComplete(flat, 0.6);
    for (Vec3& position : flat) position.y() = 0.0;
    checkComplete(flat, 0.6);
}

TEST_CASE("Particles on cell faces and far outliers are found", "[cell-grid]") {
    std::vector<Vec3> positions;
    for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y) positions.emplace_back(0.6 * x, 0.6 * y, 0.0);
    positions.emplace_back(1e7, 0.0, 0.0);
    positions.emplace_back(1e7 + 0.1, 0.0, 0.0);
    positions.emplace_back(-1e7, 9e6, -5e6);
    checkComplete(positions, 0.6);
}

TEST_CASE("The order within a cell is that of the indices", "[cell-grid]") {
    CellGrid grid;
    build(grid, clouds::strewn(500, 1.0).position, 0.5);
    for (std::size_t cell = 0; cell < grid.cellCount(); ++cell)
        CHECK(std::is_sorted(grid.order.begin() + grid.start[cell], grid.order.begin() + grid.start[cell + 1]));
}

TEST_CASE("Runs are as long as their limits allow, and end before the last cell of a line", "[cell-grid]") {
    std::vector<Vec3> positions;
    for (int x = 0; x < 12; ++x)
        for (int k = 0; k < 9; ++k) positions.emplace_back(x + 0.5, k % 3 + 0.5, k / 3 + 0.5);  // one in a cell
    CellGrid grid;
    build(grid, positions, 1.0);
    const auto cellsFrom = [&](std::uint32_t cell, std::uint32_t mostParticles, std::uint32_t mostCells) {
        const CellRun run = runFrom(grid, cell, mostParticles, mostCells);
        return run.last - run.first + 1;
    };
    CHECK(cellsFrom(0, 100, 100) == 1);
    const auto last = static_cast<std::uint32_t>(grid.dimensions[0]) - 1;
    REQUIRE(last >= 8);
    CHECK(cellsFrom(1, 100, 100) == last - 1);
    CHECK(cellsFrom(1, 100, 6) == 6);
    CHECK(cellsFrom(1, 3, 100) == 3);
    CHECK(cellsFrom(1, 0, 100) == 1);
    CHECK(cellsFrom(last, 100, 100) == 1);
}

TEST_CASE("Cells are those of the scalar path on every instruction set", "[cell-grid]") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec3> positions = clouds::strewn(203, 3.0).position;
    for (int k = -6; k <= 6; ++k) positions.emplace_back(0.6 * k, -0.6 * k, 0.6 * (k % 3));  // on faces
    for (const double far : {1e3, -1e8, 1e300, std::numeric_limits<double>::infinity(), kNan})
        for (int axis = 0; axis < 3; ++axis) {
            positions.push_back(clouds::randomVector(61, positions.size()));
            positions.back()[axis] = far;
            for (int k = 0; k < 9; ++k) positions.push_back(clouds::randomVector(62, positions.size()));
        }
    // As many cells as are needed, too few, and one, with the first cell below, at and above number 0.
    for (const std::int64_t size : {12, 5, 1})
        for (const double lowest : {-3.0, 0.0, 2.0}) {
            const CellAxes axes{CellAxis(0.6, size, lowest), CellAxis(0.6, size + 2, lowest),
                                CellAxis(0.6, size, lowest - 1.0)};
            std::vector<std::uint32_t> expected;
            for (const Vec3& position : positions) {
                expected.push_back(cellAt(axes, position));
                CHECK(expected.back() < static_cast<std::uint32_t>(size * size * (size + 2)));
            }
            for (const std::string& name : instructionSets()) {
                const OnInstructionSet only(name);
                std::vector<std::uint32_t> cells(positions.size());
                findCells(axes, positions.data(), positions.size(), cells.data());
                INFO(name << ", " << size << " cells from " << lowest << " m");
                CHECK(cells == expected);
            }
        }
}

TEST_CASE("Without particles there are no cells to visit", "[cell-grid]") {
    CellGrid grid;
    build(grid, {}, 0.6);
    CHECK(grid.order.empty());
    CHECK(neighborhood(grid, {}).count == 0);
}

TEST_CASE("Positions that are NaN or huge do no harm to the others", "[cell-grid]") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec3> positions = clouds::strewn(100, 3.0).position;
    const std::size_t sound = positions.size();
    positions.emplace_back(1e300, 0.0, -1e300);
    positions.emplace_back(kNan, 0.0, 0.0);
    CellGrid grid;
    build(grid, positions, 0.6);
    for (std::size_t p = 0; p < sound; ++p) {
        const auto found = candidates(grid, {grid.cellOf[p], grid.cellOf[p]});
        for (std::uint32_t i = 0; i < sound; ++i)
            if (squaredLength(positions[p] - positions[i]) < 0.36) CHECK(found.count(i) == 1);
    }
}
