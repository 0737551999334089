// Groups of particles that are far apart: how they are found, that groups which are said to stay apart do, and that
// strays make neighbor lists neither outdated nor large.
#include "engine/neighbors/far_groups.h"

#include <limits>
#include <numeric>
#include "tests/catch.h"

#include "engine/neighbors/neighbor_list.h"
#include "tests/engine/clouds.h"

using namespace engine;

namespace {

constexpr double kGap = 10.0;         // m
constexpr double kGroupCutoff = 0.6;  // m
constexpr double kGroupSkin = 0.06;   // m

FarGroups groupsOf(const std::vector<Vec3>& positions) {
    std::vector<std::uint32_t> ids(positions.size());
    std::iota(ids.begin(), ids.end(), 0);
    return findFarGroups(Ranks::alone(), positions, ids, kGap);
}

/// A cloud of particles about the origin, and clumps of three particles at the given places (m).
std::vector<Vec3> cloudAndClumps(const std::vector<Vec3>& places) {
    std::vector<Vec3> positions;
    for (const Vec3& place : places)
        for (std::uint64_t k = 0; k < 3; ++k) positions.push_back(place + 0.3 * clouds::randomVector(41, k));
    for (const Vec3& position : clouds::strewn(500, 1.5).position) positions.push_back(position);
    return positions;
}

/// Smallest distance of particles of two groups, at `count` times of a motion along straight lines, m.
double leastDistance(const FarGroups& groups, const std::vector<Vec3>& positions, const std::vector<Vec3>& motions,
                     int count) {
    double least = std::numeric_limits<double>::infinity();
    for (int at = 0; at <= count; ++at)
        for (std::size_t p = 0; p < positions.size(); ++p)
            for (std::size_t i = 0; i < p; ++i) {
                if (groups.of(p) == groups.of(i)) continue;
                const Vec3 approach = motions[groups.of(p)] - motions[groups.of(i)];
                least = std::min(least, (positions[p] - positions[i] + double(at) / count * approach).norm());
            }
    return least;
}

}  // namespace

TEST_CASE("Particles are one group unless a wide gap divides them", "[far-groups]") {
    CHECK_FALSE(groupsOf({}).exist());
    CHECK_FALSE(groupsOf({Vec3::Zero()}).exist());
    CHECK_FALSE(groupsOf(cloudAndClumps({})).exist());
    CHECK_FALSE(groupsOf(cloudAndClumps({Vec3(0, kGap - 2.0, 0), Vec3(0, -kGap + 2.0, 0)})).exist());
    std::vector<Vec3> stream;  // a long row without a wide gap
    for (int k = 0; k < 100; ++k) stream.emplace_back(0.9 * kGap * k, 0, 0);
    CHECK_FALSE(groupsOf(stream).exist());
}

TEST_CASE("Every clump beyond a wide gap is a group, and the largest group comes first", "[far-groups]") {
    const auto positions = cloudAndClumps({Vec3(0, -30, 0), Vec3(1e6, 0, 0), Vec3(0, 0, 9e7)});
    const FarGroups groups = groupsOf(positions);
    REQUIRE(groups.count() == 4);
    REQUIRE(groups.groupOf.size() == positions.size());
    for (std::size_t p = 9; p < positions.size(); ++p) CHECK(groups.of(p) == 0);
    CHECK(groups.of(positions.size()) == 0);  // a particle that was emitted later
    for (std::size_t clump = 0; clump < 3; ++clump) {
        const std::uint32_t group = groups.of(3 * clump);
        CHECK(group != 0);
        CHECK(groups.of(3 * clump + 1) == group);
        CHECK(groups.of(3 * clump + 2) == group);
        CHECK(groups.leaders[group] == 3 * clump);
    }
    CHECK(groups.leaders[0] == 9);
}

TEST_CASE("Groups that are said to stay apart do", "[far-groups]") {
    std::size_t apart = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        std::vector<Vec3> positions;
        FarGroups groups;
        std::vector<Vec3> motions;
        for (std::uint32_t group = 0; group < 5; ++group) {
            const Vec3 place = 12.0 * randomVector(50 + trial, group);
            groups.leaders.push_back(static_cast<std::uint32_t>(positions.size()));
            motions.push_back(Vec3(0, -20, 0) + 3.0 * randomVector(300 + trial, group));
            for (std::uint64_t k = 0; k < 3; ++k) {
                positions.push_back(place + randomVector(600 + trial, 10 * group + k));
                groups.groupOf.push_back(group);
            }
        }
        if (!stayApart(Ranks::alone(), groups, positions, motions, 1.0)) continue;
        ++apart;
        INFO("trial " << trial);
        CHECK(leastDistance(groups, positions, motions, 20) > 1.0);
    }
    CHECK(apart > 10);
    CHECK(apart < 190);
}

TEST_CASE("A motion that is NaN does not keep groups apart", "[far-groups]") {
    const auto positions = cloudAndClumps({Vec3(0, -300, 0)});
    const FarGroups groups = groupsOf(positions);
    std::vector<Vec3> motions(groups.count(), Vec3::Zero());
    CHECK(stayApart(Ranks::alone(), groups, positions, motions, kGap));
    motions[1].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(stayApart(Ranks::alone(), groups, positions, motions, kGap));
}

TEST_CASE("Strays outdate a list only where they come near other particles or part", "[far-groups][neighbor-list]") {
    const auto positions = cloudAndClumps({Vec3(0, -30, 0), Vec3(0, -60, 0)});
    const FarGroups groups = groupsOf(positions);
    NeighborList list;
    build(list, positions, {}, kGroupCutoff, kGroupSkin);
    const auto coversMoved = [&](const Vec3& first, const Vec3& second) {
        std::vector<Vec3> moved = positions;
        for (std::size_t p = 0; p < 3; ++p) moved[p] += first;
        for (std::size_t p = 3; p < 6; ++p) moved[p] += second;
        return covers(list, moved, kGroupCutoff, groups);
    };
    CHECK(coversMoved(Vec3(0, -1e6, 0), Vec3(5, -2e6, 0)));
    CHECK(coversMoved(Vec3(0, -1e6, 0), Vec3::Zero()));
    CHECK_FALSE(coversMoved(Vec3(0, -1e6, 0), Vec3(0, -1e6 + 30, 0)));  // the clumps meet
    CHECK_FALSE(coversMoved(Vec3(0, 30, 0), Vec3::Zero()));             // a clump is in the cloud
    std::vector<Vec3> parted = positions;
    for (std::size_t p = 0; p < 3; ++p) parted[p].y() -= 1e3;
    parted[2].x() += kGroupSkin;
    CHECK_FALSE(covers(list, parted, kGroupCutoff, groups));
    parted = positions;
    for (std::size_t p = 0; p < 3; ++p) parted[p].y() -= 1e3;
    parted.back().x() += kGroupSkin;  // in the cloud
    CHECK_FALSE(covers(list, parted, kGroupCutoff, groups));
}

TEST_CASE("A stray at any distance does not enlarge a list", "[far-groups][neighbor-list]") {
    const auto near = cloudAndClumps({Vec3(0, -2, 0)});
    NeighborList dense;
    build(dense, near, {}, kGroupCutoff, kGroupSkin);
    for (const double far : {1e3, 1e6, 9e7}) {
        NeighborList list;
        build(list, cloudAndClumps({Vec3(0.3 * far, -far, 0)}), {}, kGroupCutoff, kGroupSkin);
        INFO(far << " m");
        REQUIRE(list.scratch.classes.size() == 1);
        // A grid has at most two cells a particle and 64 at least.
        CHECK(list.scratch.classes[0].grid.cellCount() <= 2 * near.size());
        CHECK(list.entryCount <= dense.entryCount);
        // The rest has an entry for each particle or pair; entries have an eighth to spare.
        CHECK(bytesOf(list) <= bytesOf(dense) + bytesOf(dense) / 8 + 2 * near.size() * sizeof(std::uint32_t));
    }
}
