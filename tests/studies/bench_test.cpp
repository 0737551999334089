// The benchmark: the rows that were asked for, numbers that are consistent, hashes that do not depend on the number of
// threads.
#include "studies/bench/bench.h"
#include "render/renderer.h"
#include "scenes/build/read_scene.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tests/catch.h"

using studies::BenchRow;

namespace {

std::vector<BenchRow> benched(const std::string& filter, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::vector<BenchRow> rows;
    arena.execute([&] {
        rows = studies::runBench({.filter = filter, .counts = {500}, .secondsPerRound = 1e-4, .rounds = 3},
                                 [](const BenchRow&) {});
    });
    return rows;
}

}  // namespace

TEST_CASE("bench measures the rows that the filter names", "[bench]") {
    const auto rows = benched("forces solid", 2);
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].precision == engine::Precision::doubles);
    CHECK(rows[1].precision == engine::Precision::singles);
    CHECK(rows[0].stateHash != rows[1].stateHash);
    for (const BenchRow& row : rows) {
        CHECK(row.name == "forces");
        CHECK(row.material == "solid");
        CHECK(row.particles == 500);
        CHECK(row.neighbors > 20.0);  // 54 within twice the distance in a close packing, fewer at the surface
        CHECK(row.neighbors < 54.0);
        CHECK(row.seconds > 0.0);
        CHECK(row.nanosecondsPerPair() == Approx(1e9 * row.seconds / (500 * row.neighbors)));
    }
    CHECK(benched("nothing like it", 1).empty());
}

TEST_CASE("bench computes the same hashes on any number of threads", "[bench]") {
    for (const char* filter : {"forces", "list", "step", "triangles"}) {
        const auto one = benched(filter, 1);
        const auto three = benched(filter, 3);
        REQUIRE(one.size() == three.size());
        REQUIRE_FALSE(one.empty());
        for (std::size_t k = 0; k < one.size(); ++k) {
            INFO(one[k].name << " " << one[k].material);
            CHECK(one[k].stateHash == three[k].stateHash);
        }
    }
}

TEST_CASE("bench simulates and draws whole frames of a scene, the same on any number of threads", "[bench]") {
    const scenes::Scene drop = scenes::readScene(R"(
title = "drop"
duration = 1.0
fps = 30
[physics]
stepper = "velocity-verlet"
step = 0.002
[material]
preset = "liquid"
[[body]]
shape = "ball"
center = [0.0, 2.0, 0.0]
radius = 0.6
[[obstacle]]
shape = "plane"
)",
                                                 "drop.toml", {"still.time=0.1", "look.size=[160, 90]"});
    std::vector<std::string> hashes;
    for (const int threads : {1, 3}) {
        tbb::task_arena arena(threads);
        std::vector<BenchRow> rows;
        arena.execute([&] {
            render::Renderer renderer(drop.size, render::Quality::normal);
            rows = studies::benchFrames("drop", drop, &renderer, 2);
        });
        REQUIRE(rows.size() == 2);
        CHECK(rows[0].name == studies::kSimulateFrame);
        CHECK(rows[1].name == studies::kDrawFrame);
        CHECK(rows[0].steps == 17.0);  // steps of at most 2 ms in 33.3 ms
        for (const BenchRow& row : rows) {
            CHECK(row.material == "drop");
            CHECK(row.particles > 20);
            CHECK(row.seconds > 0.0);
            hashes.push_back(row.stateHash);
        }
        CHECK(rows[0].nanosecondsPerPair() > 0.0);
        CHECK(rows[1].nanosecondsPerPair() == 0.0);
    }
    for (const std::string& hash : hashes) CHECK(hash == hashes.front());
    const std::vector<BenchRow> undrawn = studies::benchFrames("drop", drop, nullptr, 2);
    REQUIRE(undrawn.size() == 1);
    CHECK(undrawn[0].stateHash == hashes.front());
}
