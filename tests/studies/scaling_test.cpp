// The study of scaling on small cubes, its fits on made-up rows, and its input for LAMMPS.
#include "studies/scaling/scaling.h"

#include <algorithm>
#include <cmath>

#include "studies/common/fcc_cube.h"
#include "studies/common/timing.h"
#include "tests/catch.h"

using namespace studies;

namespace {

ScalingSettings small() {
    ScalingSettings settings;
    settings.cubeSizes = {300, 600};
    settings.mostByEveryPair = 300;
    settings.rounds = 1;
    settings.secondsPerRound = 0.0;
    return settings;
}

/// Rows whose times are powers of the number of particles.
std::vector<ScalingRow> madeUp() {
    std::vector<ScalingRow> rows;
    for (const std::size_t particles : {1000U, 10000U, 100000U}) {
        const auto n = static_cast<double>(particles);
        ScalingRow row;
        row.subject = "made-up";
        row.particles = particles;
        if (particles <= 10000) row.everyPair = 1e-9 * n * n;
        row.list = 1e-7 * n;
        row.listInFloat = 1e-7 * std::pow(n, 1.1);
        rows.push_back(row);
    }
    rows.front().list = 1.0;  // below the sizes that lists are fitted over
    return rows;
}

}  // namespace

TEST_CASE("Cubes are measured with lists at every size, and by every pair up to the limit", "[scaling]") {
    std::vector<std::size_t> told;
    const auto rows = measureCubes("powder", small(), [&](const ScalingRow& row) { told.push_back(row.particles); });
    REQUIRE(rows.size() == 2);
    CHECK(told == std::vector<std::size_t>{300, 600});
    CHECK(rows[0].everyPair.has_value());
    CHECK_FALSE(rows[1].everyPair.has_value());
    for (const ScalingRow& row : rows) {
        CHECK(row.list > 0.0);
        CHECK(row.listInFloat > 0.0);
        CHECK(row.neighbors > 1.0);
        CHECK(row.stateHash.size() == 16);
    }
    CHECK(measureCubes("powder", small(), [](const ScalingRow&) {})[1].stateHash == rows[1].stateHash);
    const std::string csv = scalingCsv(rows);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
}

TEST_CASE("A cube has the number of particles, the spacing and the velocities that were asked for", "[scaling]") {
    const engine::Setup setup = fccCube("solid", 4000, {});
    CHECK(setup.initial.count() == 4000);
    // The lattice has 54 sites within two spacings; particles near the faces of the cube have fewer neighbors.
    CHECK(meanNeighbors(setup, setup.initial) > 35.0);
    CHECK(meanNeighbors(setup, setup.initial) < 54.0);
    for (const engine::Vec3& velocity : setup.initial.velocity) CHECK(velocity == engine::Vec3::Zero());
    const engine::Setup dense = fccCube("solid", 4000, {.spacing = 0.76, .speed = 1.0});
    CHECK(meanNeighbors(dense, dense.initial) > meanNeighbors(setup, setup.initial));
    for (const engine::Vec3& velocity : dense.initial.velocity) CHECK(velocity.cwiseAbs().maxCoeff() <= 1.0);
}

TEST_CASE("Exponents are slopes of logarithms over the sizes that a method is fitted to", "[scaling]") {
    const auto fits = fitsOf(madeUp());
    REQUIRE(fits.size() == 3);
    CHECK(fits[0].method == "every pair");
    CHECK(fits[0].exponent == Approx(2.0).epsilon(1e-12));
    CHECK(fits[1].exponent == Approx(1.0).epsilon(1e-12));
    CHECK(fits[2].exponent == Approx(1.1).epsilon(1e-12));
    CHECK(fits[1].from == 10000);
    CHECK(fits[1].to == 100000);
    const std::string csv = fitsCsv(fits);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
    CHECK(fitsOf({}).empty());
}

TEST_CASE("The plot has a curve for each method with times", "[scaling]") {
    const std::string script = scalingPlot(madeUp());
    CHECK(script.find("every pair, here") != std::string::npos);
    CHECK(script.find("neighbor lists in float") != std::string::npos);
    CHECK(script.find("Table 2") == std::string::npos);  // no row has a published time
    auto rows = madeUp();
    rows[0].published = 11.9e-3;
    CHECK(scalingPlot(rows).find("1000 11.9\n") != std::string::npos);
}

TEST_CASE("The median is the middle value, the upper one of two", "[scaling]") {
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0}) == 4.0);
}

TEST_CASE("LAMMPS gets a cutoff for as many neighbors as ours, and the time of its last loop is read", "[scaling]") {
    // From 45 = 4/3 pi rc^3 rho, the cutoff rc is 2.3347 at a density rho of 0.8442 and 1.5299 at 3.
    CHECK(lammpsScript(PeerForce::lennardJones).find("lj/cut/opt 2.334") != std::string::npos);
    CHECK(lammpsScript(PeerForce::dissipative).find("dpd 1.0 1.529") != std::string::npos);
    const std::string output =
        "Loop time of 0.926326 on 2 procs for 100 steps with 32000 atoms\n"
        "Loop time of 1.73655 on 2 procs for 200 steps with 32000 atoms\n";
    CHECK(lammpsSeconds(output) == 1.73655);
    CHECK_FALSE(lammpsSeconds("ERROR: Unrecognized pair style 'dpd'").has_value());
    CHECK(lammpsError("LAMMPS (7 Jan 2022)\nERROR: Unrecognized pair style 'dpd'\nLast command: pair_style") ==
          "ERROR: Unrecognized pair style 'dpd'");
    CHECK(lammpsError(output).empty());
    CHECK_FALSE(lammpsSeconds("Loop time of nothing for 200 steps").has_value());
    CHECK_FALSE(lammpsSeconds(output.substr(0, output.find('\n'))).has_value());  // the timed run is missing
}
