// The neighbor list has exactly the pairs within its reach, and tells whether it still covers particles that have
// moved.
#include "engine/neighbors/neighbor_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include "tests/catch.h"

#include "tests/engine/clouds.h"
#include "tests/engine/on_instruction_set.h"

using namespace engine;

namespace {

constexpr double kListCutoff = 0.6;  // m
constexpr double kListSkin = 0.06;   // m

std::uint32_t particleIn(const NeighborList& list, std::size_t laneSlot) {
    return list.order[static_cast<std::size_t>(list.rows.ownIndices[laneSlot])];
}

/// Particle indices in the row of a lane slot; fails on one that occurs twice.
std::set<std::uint32_t> rowOf(const NeighborList& list, std::size_t laneSlot) {
    std::set<std::uint32_t> row;
    for (std::uint32_t k = 0; k < list.rows.length[laneSlot]; ++k)
        CHECK(row.insert(list.order[list.rows.sortedIndexAt(laneSlot, k)]).second);
    return row;
}

/// Compares two lists entry by entry, padding included.
void checkSame(const NeighborList& list, const NeighborList& expected) {
    CHECK(list.order == expected.order);
    CHECK(list.sortedIndexOf == expected.sortedIndexOf);
    CHECK(list.rows.ownIndices == expected.rows.ownIndices);
    CHECK(list.rows.length == expected.rows.length);
    REQUIRE(list.rows.blocks.size() == expected.rows.blocks.size());
    for (std::size_t block = 0; block < list.rows.blocks.size(); ++block) {
        CHECK(list.rows.blocks[block].start == expected.rows.blocks[block].start);
        CHECK(list.rows.blocks[block].entries == expected.rows.blocks[block].entries);
    }
}

/// Neighbors of p within a reach (m), found by comparing it with all others.
std::set<std::uint32_t> neighborsOf(const std::vector<Vec3>& positions, std::size_t p, double reach) {
    std::set<std::uint32_t> near;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (i != p && squaredLength(positions[p] - positions[i]) < reach * reach) near.insert(i);
    return near;
}

/// Largest squared distance of a listed pair over the reach squared: float errs by 4e-6 of it.
constexpr double kFarthest = kFloatMargin + 4e-6;

bool isWithin(const std::set<std::uint32_t>& block, const std::set<std::uint32_t>& all) {
    return std::includes(all.begin(), all.end(), block.begin(), block.end());
}

/// Checks that the rows have every pair within reach, and no others but those that float cannot distinguish from them.
void checkRows(const std::vector<Vec3>& positions) {
    NeighborList list;
    build(list, positions, {}, kListCutoff, kListSkin);
    REQUIRE(list.count() == positions.size());
    std::size_t entries = 0;
    CHECK(std::set<std::uint32_t>(list.order.begin(), list.order.end()).size() == positions.size());
    for (std::size_t laneSlot = 0; laneSlot < list.count(); ++laneSlot) {
        const std::uint32_t p = particleIn(list, laneSlot);
        INFO("particle " << p);
        const auto row = rowOf(list, laneSlot);
        CHECK(isWithin(neighborsOf(positions, p, kListCutoff + kListSkin), row));
        CHECK(isWithin(row, neighborsOf(positions, p, (kListCutoff + kListSkin) * std::sqrt(kFarthest))));
        entries += row.size();
    }
    CHECK(list.entryCount == entries);
    CHECK(covers(list, positions, kListCutoff));
}

/// Positions that coincide, that lie on the faces of cells, and that are so far away that cells share storage.
std::vector<Vec3> hardPositions() {
    std::vector<Vec3> positions = clouds::strewn(60, 0.8).position;
    for (std::size_t p = 0; p < 20; ++p) positions[p] = Vec3(0.1, 0.1, 0.1);
    for (int k = -3; k <= 3; ++k) positions.emplace_back((kListCutoff + kListSkin) * k, 0.0, 0.0);
    positions.emplace_back(9e7, -9e7, 9e7);
    positions.emplace_back(9e7, -9e7, 9e7 + 0.3);
    positions.emplace_back(-9e7, 8e7, 0.0);
    return positions;
}

/// Whether a list still covers particles that have all moved far together, two of them in addition by `distance` (m)
/// relative to each other.
bool coversAfterMove(double distance, std::size_t p) {
    std::vector<Vec3> positions = clouds::strewn(50, 0.8).position;
    NeighborList list;
    build(list, positions, {}, kListCutoff, kListSkin);
    const Vec3 direction = clouds::randomVector(11, p).normalized();
    positions[p] += 0.5 * distance * direction;
    positions[(p + 1) % positions.size()] -= 0.5 * distance * direction;
    for (Vec3& position : positions) position += Vec3(3.0, -5.0, 7.0);
    return covers(list, positions, kListCutoff);
}

}  // namespace

TEST_CASE("Rows hold every other particle within the reach once", "[neighbor-list]") {
    for (const std::size_t count : {0U, 1U, 2U}) checkRows(clouds::strewn(count, 0.1).position);
    checkRows(clouds::strewn(300, 1.5).position);   // dense
    checkRows(clouds::strewn(400, 0.3).position);   // rows longer than forEachNeighbor() filters at once
    checkRows(clouds::strewn(1200, 0.5).position);  // more candidates than the search packs without testing
    checkRows(clouds::strewn(2000, 4.0).position);  // one in a cell: some cells are searched together
    checkRows(clouds::strewn(100, 40.0).position);  // most have no neighbor
}

TEST_CASE("Rows hold coincident particles, those on cell faces and far outliers", "[neighbor-list]") {
    checkRows(hardPositions());
}

TEST_CASE("No pair within the reach is lost to the rounding of float", "[neighbor-list]") {
    // Thinly spread pairs: cells are searched together, up to 8 reaches from the origin of their float coordinates.
    std::vector<Vec3> positions;
    for (std::size_t pair = 0; pair < 400; ++pair) {
        const Vec3 middle = clouds::randomVector(31, pair).cwiseProduct(Vec3(6.0, 3.0, 3.0));
        const Vec3 half = 0.5 * (kListCutoff + kListSkin) * (1 - 1e-9) * clouds::randomVector(32, pair).normalized();
        positions.push_back(middle - half);
        positions.push_back(middle + half);
    }
    for (const std::string& name : instructionSets()) {
        const OnInstructionSet only(name);
        NeighborList list;
        build(list, positions, {}, kListCutoff, kListSkin);
        for (std::uint32_t p = 0; p < positions.size(); ++p) {
            INFO("particle " << p << " with " << name);
            CHECK(rowOf(list, list.laneSlotOf(p)).count(p ^ 1U) == 1);
        }
    }
}

TEST_CASE("Positions that are NaN or huge leave the rows of the others as they are", "[neighbor-list]") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3> sound = clouds::strewn(300, 0.3).position;
    for (const Vec3& lost : {Vec3(kNan, 0, 0), Vec3(0, kNan, 0), Vec3(0, 0, kNan), Vec3(1e300, -1e300, 0)}) {
        std::vector<Vec3> positions = {lost};  // the first particle of its cell
        positions.insert(positions.end(), sound.begin(), sound.end());
        NeighborList list;
        build(list, positions, {}, kListCutoff, kListSkin);
        for (std::size_t p = 1; p < positions.size(); ++p)
            CHECK(isWithin(neighborsOf(positions, p, kListCutoff + kListSkin), rowOf(list, list.laneSlotOf(p))));
        CHECK(rowOf(list, list.laneSlotOf(0)).empty());
    }
}

TEST_CASE("A list covers until two particles have come nearer by the skin", "[neighbor-list]") {
    for (std::size_t p = 0; p < 50; p += 7) {
        CHECK(coversAfterMove(kListSkin * (1 - 1e-12),
                              p));  // positions of 10 m are rounded by 1e-15 m, 2e-14 of the skin
        CHECK_FALSE(coversAfterMove(kListSkin * (1 + 1e-12), p));  // same
        CHECK_FALSE(coversAfterMove(std::numeric_limits<double>::quiet_NaN(), p));
    }
}

TEST_CASE("A list covers neither a wider cutoff nor another number of particles", "[neighbor-list]") {
    std::vector<Vec3> positions = clouds::strewn(10, 0.8).position;
    NeighborList list;
    CHECK_FALSE(covers(list, positions, kListCutoff));  // never built
    build(list, positions, {}, kListCutoff, kListSkin);
    CHECK(covers(list, positions, kListCutoff + kListSkin));
    CHECK_FALSE(covers(list, positions, (kListCutoff + kListSkin) * (1 + 1e-12)));  // far above the rounding of the sum
    positions.pop_back();
    CHECK_FALSE(covers(list, positions, kListCutoff));
}

TEST_CASE("A list covers particles in free fall until one moves relative to the others", "[neighbor-list]") {
    const std::vector<Vec3> before = clouds::strewn(3000, 2.5).position;
    NeighborList list;
    build(list, before, {}, kListCutoff, kListSkin);
    std::vector<Vec3> fallen = before;
    for (Vec3& position : fallen) position.y() -= 1.0;
    CHECK(covers(list, fallen, kListCutoff));
    for (const std::size_t p : {0U, 1975U, 1976U, 2999U}) {
        std::vector<Vec3> parted = fallen;
        parted[p].x() += 0.9 * kListSkin;  // 0.45 skins from the center of all displacements
        CHECK(covers(list, parted, kListCutoff));
        parted[p].x() += 0.2 * kListSkin;
        CHECK_FALSE(covers(list, parted, kListCutoff));
    }
}

TEST_CASE("A list that covers holds every pair that has come within the cutoff", "[neighbor-list]") {
    std::vector<Vec3> positions = clouds::strewn(300, 1.2).position;
    NeighborList list;
    build(list, positions, {}, kListCutoff, kListSkin);
    for (std::size_t p = 0; p < positions.size(); ++p)
        positions[p] += 0.499 * kListSkin * clouds::randomVector(12, p).normalized();
    REQUIRE(covers(list, positions, kListCutoff));
    for (std::size_t laneSlot = 0; laneSlot < list.count(); ++laneSlot) {
        const auto row = rowOf(list, laneSlot);
        const std::uint32_t p = particleIn(list, laneSlot);
        for (const std::uint32_t i : neighborsOf(positions, p, kListCutoff)) {
            INFO("particles " << p << " and " << i);
            CHECK(row.count(i) == 1);
        }
    }
}

TEST_CASE("Within a block, lane slots are sorted by the length of their rows", "[neighbor-list]") {
    NeighborList list;
    build(list, clouds::strewn(3001, 2.5).position, {}, kListCutoff, kListSkin);
    for (std::size_t laneSlot = 1; laneSlot < list.count(); ++laneSlot)
        if (laneSlot % kSlotsPerBlock != 0) CHECK(list.rows.length[laneSlot] <= list.rows.length[laneSlot - 1]);
    for (std::uint32_t p = 0; p < list.count(); ++p) CHECK(particleIn(list, list.laneSlotOf(p)) == p);
}

TEST_CASE("Rows are padded to the longest of their cluster with their own particle", "[neighbor-list]") {
    for (const std::size_t count : {1U, 37U, 3001U}) {
        NeighborList list;
        build(list, clouds::strewn(count, 2.5).position, {}, kListCutoff, kListSkin);
        for (std::size_t laneSlot = 0; laneSlot < list.rows.ownIndices.size(); ++laneSlot) {
            const std::size_t first = laneSlot / kClusterSize * kClusterSize;
            const std::uint32_t longest =
                *std::max_element(&list.rows.length[first], &list.rows.length[first] + kClusterSize);
            if (laneSlot >= count) CHECK(list.rows.length[laneSlot] == 0);
            for (std::uint32_t k = list.rows.length[laneSlot]; k < longest; ++k)
                CHECK(list.rows.sortedIndexAt(laneSlot, k) ==
                      static_cast<std::uint32_t>(list.rows.ownIndices[laneSlot]));
        }
    }
}

TEST_CASE("A list built again is that of the new positions", "[neighbor-list]") {
    NeighborList list;
    for (const std::size_t count : {3001U, 50U, 2000U}) {  // fewer, with longer rows, and more again
        const std::vector<Vec3> positions = clouds::strewn(count, 1.5).position;
        NeighborList expected;
        build(expected, positions, {}, kListCutoff, kListSkin);
        build(list, positions, {}, kListCutoff, kListSkin);
        checkSame(list, expected);
    }
}

TEST_CASE("The same rows for any number of threads", "[neighbor-list][threads]") {
    const std::vector<Vec3> positions = clouds::strewn(3000, 2.5).position;
    NeighborList expected;
    build(expected, positions, {}, kListCutoff, kListSkin);
    for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
        NeighborList list;
        clouds::onThreads(threads, [&] { build(list, positions, {}, kListCutoff, kListSkin); });
        checkSame(list, expected);
    }
}

TEST_CASE("The same rows on every instruction set", "[neighbor-list]") {
    for (const std::vector<Vec3>& positions :
         {clouds::strewn(1000, 1.5).position, clouds::strewn(1, 1.0).position, clouds::strewn(37, 0.1).position,
          clouds::strewn(1200, 0.5).position, clouds::strewn(2000, 4.0).position, clouds::strewn(100, 40.0).position,
          hardPositions()}) {
        NeighborList expected;
        build(expected, positions, {}, kListCutoff, kListSkin);
        for (const std::string& name : instructionSets()) {
            const OnInstructionSet only(name);
            NeighborList list;
            build(list, positions, {}, kListCutoff, kListSkin);
            INFO(positions.size() << " with " << name);
            checkSame(list, expected);
        }
    }
}

TEST_CASE("Rows are as complete in worlds of any size", "[neighbor-list]") {
    for (const double unit : {1e-30, 1e30}) {  // the squares of neither fit in float
        std::vector<Vec3> positions = clouds::strewn(200, 1.0).position;
        NeighborList expected;
        build(expected, positions, {}, kListCutoff, kListSkin);
        for (Vec3& position : positions) position *= unit;
        NeighborList list;
        build(list, positions, {}, kListCutoff * unit, kListSkin * unit);
        for (std::size_t laneSlot = 0; laneSlot < list.count(); ++laneSlot)
            CHECK(rowOf(list, laneSlot) == rowOf(expected, expected.laneSlotOf(particleIn(list, laneSlot))));
    }
}
