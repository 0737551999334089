// Who is near a sortedIndex: nobody is missing, nobody twice, and not everybody is asked.
#include "engine/neighbors/linked_cells.h"

#include <map>

#include "engine/core/random.h"
#include "tests/catch.h"

using namespace engine;

namespace {

/// In a cube of this edge around the origin, m.
std::vector<Vec3> scattered(std::size_t count, double edge) {
    std::vector<Vec3> positions;
    for (std::size_t p = 0; p < count; ++p) {
        const auto along = [&](std::uint64_t axis) { return 0.5 * edge * symmetricUnit(randomBits(3, axis, p)); };
        positions.emplace_back(along(0), along(1), along(2));
    }
    return positions;
}

std::map<std::size_t, int> visitsNear(const LinkedCells& cells, const Vec3& sortedIndex) {
    std::map<std::size_t, int> visits;
    cells.forEachNear(sortedIndex, [&](std::size_t p) { ++visits[p]; });
    return visits;
}

}  // namespace

TEST_CASE("Linked cells find everybody within a width, each once, however they were added", "[linked-cells]") {
    const double width = 0.3;
    std::vector<Vec3> positions = scattered(400, 4.0);
    positions.emplace_back(0.3 * 3, -0.3, 0.6);  // on corners of cells
    positions.emplace_back(1e8, -1e8, 0.1);      // an outlier
    positions.emplace_back(1e8 + 0.2, -1e8, 0.1);
    const std::vector<Vec3> first(positions.begin(), positions.begin() + 50);
    LinkedCells grown(width, first);
    for (std::size_t p = first.size(); p < positions.size(); ++p) grown.add(positions[p]);
    const LinkedCells whole(width, positions);
    for (const Vec3& sortedIndex : positions) {
        const std::map<std::size_t, int> visits = visitsNear(whole, sortedIndex);
        CHECK(visits == visitsNear(grown, sortedIndex));
        for (const auto& [p, count] : visits) CHECK(count == 1);
        for (std::size_t p = 0; p < positions.size(); ++p)
            if ((positions[p] - sortedIndex).norm() <= width) CHECK(visits.count(p) == 1);
    }
}

TEST_CASE("Linked cells ask a few of many", "[linked-cells]") {
    const std::vector<Vec3> positions = scattered(20000, 30.0);  // three quarters of a particle in a cell of width 1
    const LinkedCells cells(1.0, positions);
    std::size_t visits = 0;
    for (const Vec3& sortedIndex : positions) cells.forEachNear(sortedIndex, [&](std::size_t) { ++visits; });
    CHECK(visits < 30 * positions.size());  // 27 cells hold 20 of them
}

TEST_CASE("Without cells nobody is near", "[linked-cells]") {
    LinkedCells none;
    none.add(Vec3::Zero());
    CHECK(visitsNear(none, Vec3::Zero()).empty());
}
