// The linked cells find every particle near a point exactly once, and visit few others.
#include "engine/neighbors/linked_cells.h"

#include <map>

#include "engine/core/random.h"
#include "tests/catch.h"

using namespace engine;

namespace {

/// Random positions in a cube of an edge (m) around the origin.
std::vector<Vec3> scattered(std::size_t count, double edge) {
    std::vector<Vec3> positions;
    for (std::size_t p = 0; p < count; ++p) {
        const auto along = [&](std::uint64_t axis) { return 0.5 * edge * symmetricUnit(randomBits(3, axis, p)); };
        positions.emplace_back(along(0), along(1), along(2));
    }
    return positions;
}

std::map<std::size_t, int> visitsNear(const LinkedCells& cells, const Vec3& point) {
    std::map<std::size_t, int> visits;
    cells.forEachNear(point, [&](std::size_t p) { ++visits[p]; });
    return visits;
}

}  // namespace

TEST_CASE("Linked cells find every particle within a width once, in whatever order they were added", "[linked-cells]") {
    const double width = 0.3;
    std::vector<Vec3> positions = scattered(400, 4.0);
    positions.emplace_back(0.3 * 3, -0.3, 0.6);  // on corners of cells
    positions.emplace_back(1e8, -1e8, 0.1);      // an outlier
    positions.emplace_back(1e8 + 0.2, -1e8, 0.1);
    const std::vector<Vec3> first(positions.begin(), positions.begin() + 50);
    LinkedCells grown(width, first);
    for (std::size_t p = first.size(); p < positions.size(); ++p) grown.add(positions[p]);
    const LinkedCells whole(width, positions);
    for (const Vec3& point : positions) {
        const std::map<std::size_t, int> visits = visitsNear(whole, point);
        CHECK(visits == visitsNear(grown, point));
        for (const auto& [p, count] : visits) CHECK(count == 1);
        for (std::size_t p = 0; p < positions.size(); ++p)
            if ((positions[p] - point).norm() <= width) CHECK(visits.count(p) == 1);
    }
}

TEST_CASE("Linked cells visit few of many particles", "[linked-cells]") {
    const std::vector<Vec3> positions = scattered(20000, 30.0);  // 0.74 particles in a cell of width 1 m
    const LinkedCells cells(1.0, positions);
    std::size_t visits = 0;
    for (const Vec3& point : positions) cells.forEachNear(point, [&](std::size_t) { ++visits; });
    CHECK(visits < 30 * positions.size());  // 27 cells hold 20 of them
}

TEST_CASE("Cells without a width find nothing", "[linked-cells]") {
    LinkedCells none;
    none.add(Vec3::Zero());
    CHECK(visitsNear(none, Vec3::Zero()).empty());
}
