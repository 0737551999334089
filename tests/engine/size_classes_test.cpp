// Neighbor lists of particles of very different sizes have every pair that acts, and few others.
#include "engine/neighbors/size_classes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include "tests/catch.h"

#include "engine/neighbors/neighbor_list.h"
#include "tests/engine/clouds.h"
#include "tests/engine/on_instruction_set.h"

using namespace engine;

namespace {

constexpr double kRatio = 1.5;  // cutoff of a pair over the sum of its radii
constexpr double kSkin = 0.01;  // m

/// Particles in a cube with radii from `largest` down to the share `least` of it, evenly distributed on a logarithmic
/// scale. Some coincide, some are far away, where cells share storage.
Particles mixture(std::size_t count, double halfEdge, double largest, double least) {
    Particles particles = clouds::strewn(count, halfEdge);
    for (std::size_t p = 0; p < count; ++p)
        particles.radius[p] = largest * std::pow(least, 0.5 + 0.5 * clouds::randomVector(5, p).x());
    particles.radius[0] = largest;
    particles.position[1] = particles.position[0];
    particles.position[2] = Vec3(9e6, -9e6, 9e6);
    particles.position[3] = particles.position[2] + Vec3(largest, 0.0, 0.0);
    return particles;
}

/// One large particle among many small ones.
Particles boulder(std::size_t count, double radius) {
    Particles particles = clouds::strewn(count, 0.5);
    std::ranges::fill(particles.radius, 0.02);
    particles.radius[count / 2] = radius;
    return particles;
}

NeighborList listOf(const Particles& particles) {
    NeighborList list;
    const double cutoff = kRatio * 2.0 * *std::ranges::max_element(particles.radius);
    build(list, particles.position, particles.radius, cutoff, kSkin);
    return list;
}

/// Checks each row against every other particle: those within the pair's cutoff and the skin are in it once; those
/// beyond what the largest particles of both classes reach are not.
void checkRows(const Particles& particles) {
    const NeighborList list = listOf(particles);
    const std::size_t count = particles.count();
    REQUIRE(list.count() == count);
    CHECK(std::set<std::uint32_t>(list.order.begin(), list.order.end()).size() == count);
    std::size_t entries = 0;
    for (std::size_t p = 0; p < count; ++p) {
        const std::size_t laneSlot = list.laneSlotOf(p);
        std::set<std::uint32_t> row;
        for (std::uint32_t k = 0; k < list.rows.length[laneSlot]; ++k)
            CHECK(row.insert(list.order[list.rows.sortedIndexAt(laneSlot, k)]).second);
        CHECK(row.count(static_cast<std::uint32_t>(p)) == 0);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i == p) continue;
            const double distance = (particles.position[p] - particles.position[i]).norm();
            const double cutoff = kRatio * (particles.radius[p] + particles.radius[i]);
            if (distance < cutoff + kSkin && row.count(i) == 0) FAIL_CHECK("particle " << p << " misses " << i);
            if (distance > 2.0 * cutoff + 1.001 * kSkin && row.count(i) == 1)
                FAIL_CHECK("particle " << p << " lists " << i << ", which is far");
        }
        entries += row.size();
    }
    CHECK(list.entryCount == entries);
}

std::size_t classCount(const std::vector<double>& radii) {
    std::vector<SizeClass> classes;
    divideBySize(sizesOf(Ranks::alone(), radii), radii, radii.size(), classes);
    std::size_t particles = 0;
    for (const SizeClass& sizeClass : classes) {
        CHECK(sizeClass.sorted.begin == particles);
        particles = sizeClass.sorted.end;
    }
    CHECK(particles == radii.size());
    return classes.size();
}

}  // namespace

TEST_CASE("particles whose radii differ by less than two are one class") {
    CHECK(classCount({0.1, 0.1, 0.1}) == 1);
    CHECK(classCount({0.1, 0.199, 0.15}) == 1);
    CHECK(classCount({0.1, 0.2}) == 2);
    CHECK(classCount({0.1, 0.15, 0.2, 0.9, 25.0}) == 4);
    CHECK(classCount({}) == 1);
    CHECK(classCount({1e-9, 1e7}) == 2);
    CHECK(typicalRelativeRadius(sizesOf(Ranks::alone(), std::vector{0.1, 0.15})) == 1.0);
    CHECK(typicalRelativeRadius(sizesOf(Ranks::alone(), std::vector{0.1, 0.12, 1.0})) == 0.12);
}

TEST_CASE("rows of particles of any sizes have every pair that acts, and few others") {
    for (const std::string& name : instructionSets()) {
        INFO(name);
        const OnInstructionSet on(name);
        checkRows(mixture(600, 0.8, 0.3, 1.0 / 25.0));
        checkRows(mixture(400, 0.6, 0.1, 0.3));
        checkRows(mixture(300, 50.0, 8.0, 1e-3));
        checkRows(boulder(700, 0.5));
        checkRows(boulder(130, 0.2));
        Particles alone = clouds::strewn(3, 1e3);
        alone.radius = {0.02, 0.5, 0.1};
        checkRows(alone);
    }
}

TEST_CASE("a list of many sizes is the same for any number of threads and after a coarser one", "[threads]") {
    const Particles particles = mixture(2000, 1.0, 0.3, 0.05);
    const NeighborList expected = listOf(particles);
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
        NeighborList list;
        build(list, clouds::strewn(500, 1.0).position, {}, 0.5, kSkin);
        clouds::onThreads(threads,
                          [&] { build(list, particles.position, particles.radius, expected.cutoff, expected.skin); });
        CHECK(list.order == expected.order);
        REQUIRE(list.rows.blocks.size() == expected.rows.blocks.size());
        for (std::size_t block = 0; block < list.rows.blocks.size(); ++block)
            CHECK(list.rows.blocks[block].entries == expected.rows.blocks[block].entries);
    }
}

TEST_CASE("one large particle does not lengthen the rows of the small ones") {
    const std::size_t equal = listOf(boulder(4000, 0.02)).entryCount;
    for (const double ratio : {2.0, 5.0, 10.0, 25.0}) {
        INFO("ratio " << ratio);
        const NeighborList list = listOf(boulder(4000, 0.02 * ratio));
        std::size_t large = list.rows.length[list.laneSlotOf(2000)];
        CHECK(list.entryCount <= equal + 2 * large);
    }
}

TEST_CASE("forces of particles of many sizes are those of every pair") {
    Particles particles = mixture(500, 0.6, 0.2, 1.0 / 20.0);
    for (std::size_t p = 0; p < particles.count(); ++p) particles.mass[p] = 1e3 * std::pow(particles.radius[p], 3.0);
    for (const char* preset : {"liquid", "solid", "powder"}) {
        INFO(preset);
        ForceEvaluator grid(clouds::forceFieldOf(preset), ForceMethod::grid, Precision::doubles);
        ForceEvaluator everyPair(clouds::forceFieldOf(preset), ForceMethod::reference, Precision::doubles);
        std::vector<Vec3> forces, expected;
        grid.evaluatePairs(particles, particles.velocity, forces);
        everyPair.evaluatePairs(particles, particles.velocity, expected);
        for (std::size_t p = 0; p < particles.count(); ++p)
            CHECK((forces[p] - expected[p]).norm() <= 1e-12 * expected[p].norm() + 1e-9);
    }
}
