// Tests the pressure of a lattice against the slope of its energy, and the height of a column against closed forms.
#include "tests/catch.h"

#include <cmath>

#include "engine/force_law/compression.h"
#include "engine/force_law/pair_law.h"

using engine::Column;
using engine::Material;
using engine::materialPreset;

namespace {

double cellVolume(double spacing) {
    return spacing * spacing * spacing / std::sqrt(2.0);
}

/// Energy per particle of a face-centered cubic lattice, J: half the sum over all pairs that a particle has, which are
/// counted one by one.
double latticeEnergy(const Material& material, double spacing) {
    const auto law = engine::pairConstants<double>(material, 2.0 * material.radius);
    double sum = 0.0;
    for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
            for (int z = -8; z <= 8; ++z)
                if ((x + y + z) % 2 == 0 && (x != 0 || y != 0 || z != 0))
                    sum += engine::pairEnergy(spacing * std::sqrt(0.5 * (x * x + y * y + z * z)), law);
    return 0.5 * sum;
}

}  // namespace

TEST_CASE("the pressure of a lattice is the slope of its energy over its volume") {
    for (const char* name : {"liquid", "solid", "oil", "jam"}) {
        const Material material = *materialPreset(name);
        for (const double share : {0.35, 0.6, 0.8, 0.95}) {
            INFO(name << " at " << share << " rest lengths");
            const double spacing = share * 2.0 * material.radius;
            const double step = 1e-5 * spacing;
            const double slope = (latticeEnergy(material, spacing + step) - latticeEnergy(material, spacing - step)) /
                                 (cellVolume(spacing + step) - cellVolume(spacing - step));
            // A central difference errs by the square of its relative step, 1e-10, and by the rounding of the energies
            // over that step, 1e-16 / 1e-5, both times factors of the law's curvature.
            CHECK(engine::latticePressure(material, spacing) == Approx(-slope).epsilon(1e-7));
        }
    }
}

TEST_CASE("a lattice without attraction beyond its nearest neighbors rests at two radii, another one closer") {
    CHECK(engine::restSpacing(*materialPreset("liquid")) == Approx(0.3));
    CHECK(engine::restSpacing(*materialPreset("oil")) == Approx(0.16));
    const Material solid = *materialPreset("solid");
    CHECK(engine::restSpacing(solid) < 0.29);
    CHECK(engine::latticePressure(solid, engine::restSpacing(solid)) ==
          Approx(0.0).margin(1e-9 * engine::latticePressure(solid, 0.2)));
}

TEST_CASE("a column sinks by as much as the weight above each of its parts asks for") {
    const Material material = *materialPreset("oil");
    const Column column{.height = 1.5, .spacing = 0.16, .gravity = 9.81};
    // The column in 2,000 slices from the top: each slice has the spacing at which the pressure is the weight above it,
    // found by halving. The midpoint rule errs by less than 1/2,000 of the whole.
    constexpr int kSlices = 2000;
    const double floorPressure = material.mass * column.gravity * column.height / cellVolume(column.spacing);
    double height = 0.0;
    for (int slice = 0; slice < kSlices; ++slice) {
        const double wanted = (slice + 0.5) / kSlices * floorPressure;
        double tight = 0.3 * column.spacing;
        double loose = column.spacing;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (tight + loose);
            (engine::latticePressure(material, middle) > wanted ? tight : loose) = middle;
        }
        height += cellVolume(loose) / cellVolume(column.spacing) / kSlices;
    }
    CHECK(engine::settledShare(material, column) == Approx(height).margin(1.0 / kSlices));
    CHECK(height < 0.7);
}

TEST_CASE("the strength that is chosen for a share gives that share") {
    for (const char* name : {"liquid", "oil", "solid", "jam"})
        for (const double share : {0.3, 0.8, 0.95}) {
            Material material = *materialPreset(name);
            const Column column{.height = 3.0, .spacing = engine::restSpacing(material), .gravity = 9.81};
            const auto repulsion = engine::repulsionForShare(material, column, share);
            REQUIRE(repulsion.has_value());
            material.repulsion = *repulsion;
            INFO(name << " to " << share << " with b1 " << *repulsion);
            // The interval is halved until it is no wider than rounding.
            CHECK(engine::settledShare(material, column) == Approx(share).epsilon(1e-9));
        }
    const Material liquid = *materialPreset("liquid");
    CHECK(!engine::repulsionForShare(liquid, {.height = 1.0, .spacing = 0.35}, 0.95).has_value());
}

TEST_CASE("a column without weight keeps its height, one without repulsion does not") {
    Material material = *materialPreset("liquid");
    CHECK(engine::settledShare(material, {.height = 2.0, .spacing = 0.3, .gravity = 0.0}) == Approx(1.0));
    CHECK(engine::settledShare(material, {.height = 2.0, .spacing = 0.27, .gravity = 0.0}) ==
          Approx(std::pow(0.3 / 0.27, 3.0)));
    material.repulsion = 0.0;
    CHECK(engine::settledShare(material, {.height = 2.0, .spacing = 0.3, .gravity = 9.8}) == 0.0);
}

TEST_CASE("a material with particles of another radius keeps its density and its stiffness") {
    for (const Material& material : engine::materialPresets()) {
        const Material fine = engine::withRadius(material, 0.4 * material.radius);
        INFO(material.name);
        const double rest = 2.0 * material.radius;
        CHECK(fine.mass / cellVolume(0.4 * rest) == Approx(material.mass / cellVolume(rest)));
        CHECK(engine::latticePressure(fine, 0.4 * 0.8 * rest) == Approx(engine::latticePressure(material, 0.8 * rest)));
        CHECK(engine::settledShare(fine, {.height = 2.0, .spacing = 0.4 * rest}) ==
              Approx(engine::settledShare(material, {.height = 2.0, .spacing = rest})));
        CHECK(fine.damping == Approx(0.4 * material.damping));
        CHECK(fine.repulsionReach == material.repulsionReach);
        const Material same = engine::withRadius(material, material.radius);
        CHECK(same.mass == material.mass);
        CHECK(same.repulsion == material.repulsion);
        CHECK(same.damping == material.damping);
    }
}

TEST_CASE("Only particles that attract beyond their nearest neighbors draw a loose column together") {
    for (const Material& material : materialPresets()) {
        INFO(material.name);
        Column column{.height = 1.0, .spacing = 2.0 * material.radius};
        CHECK(drawsTogether(material, column) == (material.name == "solid"));
        column.spacing = 0.5 * material.radius;
        CHECK_FALSE(drawsTogether(material, column));
    }
}
