// The forces over the neighbor list against the O(n^2) reference, and the reference against sums worked by hand and the
// gradient of its energy.
#include "engine/forces/forces.h"

#include <set>
#include "tests/catch.h"

#include "engine/forces/external_forces.h"
#include "tests/engine/clouds.h"
#include "tests/engine/rounding.h"

using namespace engine;

namespace {

std::vector<Vec3> reference(const ForceField& field, const Particles& particles) {
    std::vector<Vec3> forces;
    pairForcesReference(field, particles, particles.velocity, forces);
    return forces;
}

std::vector<Vec3> onGrid(const ForceField& field, const Particles& particles) {
    ForceEvaluator evaluator(field, ForceMethod::grid);
    std::vector<Vec3> forces;
    evaluator.evaluatePairs(particles, particles.velocity, forces);
    return forces;
}

/// Sum of the lengths of the pair forces on p, with which the rounding of any order of summation scales.
double forceScale(const ForceField& field, const Particles& particles, std::size_t p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < particles.count(); ++i) {
        if (i == p) continue;
        const double rest = particles.radius[p] + particles.radius[i];
        const Material material = mixed(field.materials[particles.material[p]], field.materials[particles.material[i]]);
        const auto c = pairConstants<double>(material, rest);
        Vec3 separation = particles.position[p] - particles.position[i];
        if (squaredLength(separation) == 0.0) separation = Vec3(kCoincidentShare * rest, 0.0, 0.0);
        const double approach = dot(particles.velocity[p] - particles.velocity[i], separation);
        const double lengthSq = squaredLength(separation);
        sum += std::abs(pairCoefficient<PairTerms{}>(lengthSq, approach, c)) * std::sqrt(lengthSq);
    }
    return sum;
}

void checkGridAgainstReference(const ForceField& field, const Particles& particles) {
    const auto expected = reference(field, particles);
    const auto actual = onGrid(field, particles);
    REQUIRE(actual.size() == expected.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
        // The forces of pairs have equal bits. Two orders of summation differ by at most two roundings of the running
        // sum for each term.
        const double tolerance = 2.0 * static_cast<double>(particles.count()) * kEps * forceScale(field, particles, p);
        const double difference = (actual[p] - expected[p]).cwiseAbs().maxCoeff();
        INFO("particle " << p << ": " << actual[p].transpose() << " against " << expected[p].transpose());
        CHECK(difference <= tolerance);
    }
}

}  // namespace

TEST_CASE("The grid agrees with the reference for every preset", "[forces]") {
    for (const Material& material : materialPresets()) {
        INFO(material.name);
        checkGridAgainstReference(clouds::forceFieldOf(material), clouds::strewn(400, 1.1));
        checkGridAgainstReference(clouds::forceFieldOf(material), clouds::strewnUnequal(400, 1.1));
    }
}

TEST_CASE("The grid agrees with the reference for several materials", "[forces]") {
    ForceField field;
    field.materials = {*materialPreset("liquid"), *materialPreset("solid"), *materialPreset("powder")};
    Particles particles = clouds::strewnUnequal(300, 1.0);
    for (std::size_t p = 0; p < particles.count(); ++p) particles.material[p] = static_cast<std::uint32_t>(p % 3);
    checkGridAgainstReference(field, particles);
}

TEST_CASE("Forces have the same bits whether mixtures are tabulated or not", "[forces][threads]") {
    ForceField field;
    field.materials = {*materialPreset("liquid"), *materialPreset("solid"), *materialPreset("jam")};
    Particles particles = clouds::strewnUnequal(300, 1.0);
    for (std::size_t p = 0; p < particles.count(); ++p) particles.material[p] = static_cast<std::uint32_t>(p % 3);
    const auto tabulated = onGrid(field, particles);
    field.materials.resize(kMostTabulated + 1, field.materials.front());
    CHECK(tabulatedMixtures(field.materials).empty());
    CHECK(onGrid(field, particles) == tabulated);
}

TEST_CASE("The grid agrees with the reference without damping", "[forces]") {
    for (const char* name : {"solid", "powder"}) {
        Material material = *materialPreset(name);
        material.damping = 0.0;
        checkGridAgainstReference(clouds::forceFieldOf(material), clouds::strewn(300, 1.0));
    }
}

TEST_CASE("The grid agrees with the reference for few, coincident and far particles", "[forces]") {
    const ForceField field = clouds::forceFieldOf("solid");
    for (const std::size_t count : {0U, 1U, 2U}) checkGridAgainstReference(field, clouds::strewn(count, 0.1));
    checkGridAgainstReference(field, clouds::strewn(60, 0.05));
    Particles coincident = clouds::strewn(20, 0.3);
    for (std::size_t p = 0; p < 8; ++p) coincident.position[p] = Vec3(0.1, 0.1, 0.1);
    checkGridAgainstReference(field, coincident);
    ForceEvaluator grid(field, ForceMethod::grid);
    std::vector<Vec3> forces;
    const double energy = pairEnergyReference(field, coincident);
    CHECK_THAT(grid.evaluateFree(coincident, coincident.velocity, forces), Catch::Matchers::WithinRel(energy, 1e-12));
    CHECK_THAT(grid.pairEnergyGrid(coincident), Catch::Matchers::WithinRel(energy, 1e-12));
    for (const Vec3& force : onGrid(field, coincident)) CHECK(force.allFinite());
    Particles far = clouds::strewn(100, 0.8);
    far.position[3] = Vec3(9e7, -9e7, 9e7);
    far.position[4] = Vec3(9e7, -9e7, 9e7 + 0.2);
    checkGridAgainstReference(field, far);
}

TEST_CASE("The force between two particles is that worked by hand", "[forces]") {
    Particles particles;
    append(particles, {.position = Vec3(0.2, 0, 0), .velocity = Vec3(-1, 0.5, 0)});
    append(particles, {.position = Vec3(0, 0, 0), .velocity = Vec3(0, 0, 0)});
    // b1/D^4 (1 - D^2/D0^2)^2 = 0.01/0.0016 (5/9)^2 and b_d (1 - D^2/0.36) V = 1 (1 - 1/9) along the axis.
    const double expected = 0.01 / 0.0016 * 25.0 / 81.0 + 8.0 / 9.0;
    const auto forces = onGrid(clouds::forceFieldOf("liquid"), particles);
    CHECK(forces[0].x() == Approx(expected).epsilon(16 * kEps));  // a dozen roundings
    CHECK(forces[0].y() == 0.0);
    CHECK(forces[1] == -forces[0]);
}

TEST_CASE("Pair forces have neither a sum nor a torque", "[forces]") {
    const Particles particles = clouds::strewnUnequal(500, 1.2);
    const ForceField field = clouds::forceFieldOf("solid");
    const auto forces = onGrid(field, particles);
    Vec3 sum = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    double scale = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p) {
        sum += forces[p];
        torque += particles.position[p].cross(forces[p]);
        scale += forceScale(field, particles, p);
    }
    const double tolerance = 500 * kEps * scale;  // one rounding of the running sum for each of 500 terms
    CHECK(sum.cwiseAbs().maxCoeff() <= tolerance);
    CHECK(torque.cwiseAbs().maxCoeff() <= 2 * 1.2 * tolerance);  // arms of up to 1.2 m, two products each
}

TEST_CASE("The forces are minus the gradient of the energy, on the grid and by every pair", "[forces]") {
    Material material = *materialPreset("solid");
    material.damping = 0.0;
    const ForceField field = clouds::forceFieldOf(material);
    Particles particles = clouds::strewn(60, 0.45);
    ForceEvaluator evaluator(field, ForceMethod::grid);
    const double total = pairEnergyReference(field, particles);
    CHECK(evaluator.pairEnergyGrid(particles) == Approx(total).epsilon(1e4 * kEps));  // 3600 terms, either order
    const auto forces = reference(field, particles);
    for (const std::size_t p : {0U, 7U, 31U})
        for (int axis = 0; axis < 3; ++axis) {
            const double h = 1e-6;
            Particles moved = particles;
            moved.position[p][axis] += h;
            const double above = pairEnergyReference(field, moved);
            moved.position[p][axis] -= 2 * h;
            const double below = pairEnergyReference(field, moved);
            // Rounding 60^2 eps |U| / h and truncation (h/D)^2 F with D at least the core of 0.075.
            const double tolerance = 3600 * kEps * std::abs(total) / h + 2e-9 * forceScale(field, particles, p);
            CHECK(std::abs(forces[p][axis] + (above - below) / (2 * h)) <= tolerance);
        }
}

TEST_CASE("The same bits for any number of threads", "[forces][threads]") {
    const Particles particles = clouds::strewnUnequal(2000, 2.0);
    const ForceField field = clouds::forceFieldOf("solid");
    const auto expected = onGrid(field, particles);
    for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
        std::vector<Vec3> forces;
        clouds::onThreads(threads, [&] { forces = onGrid(field, particles); });
        CHECK(forces == expected);
    }
}

TEST_CASE("Terms and cutoff are those that the materials need", "[forces]") {
    const Particles equal = clouds::strewn(10, 1.0);
    const ForceTerms powder = termsFor(clouds::forceFieldOf("powder"), equal);
    CHECK_FALSE(powder.pair.attraction);
    CHECK(powder.pair.damping);
    CHECK(powder.uniform());
    CHECK(powder.cutoff == Approx(0.3));
    CHECK(termsFor(clouds::forceFieldOf("liquid"), equal).cutoff == Approx(0.6));
    CHECK(termsFor(clouds::forceFieldOf("solid"), equal).pair.attraction);
    CHECK_FALSE(termsFor(clouds::forceFieldOf("solid"), clouds::strewnUnequal(10, 1.0)).uniform());
    Material undamped = *materialPreset("liquid");
    undamped.damping = 0.0;
    CHECK_FALSE(termsFor(clouds::forceFieldOf(undamped), equal).pair.damping);
    CHECK(termsFor(clouds::forceFieldOf(undamped), equal).cutoff ==
          Approx(0.3));  // without damping its reach does not count
    CHECK(powder.pair.equalReach);
    CHECK(termsFor(clouds::forceFieldOf(undamped), equal).pair.equalReach);
    CHECK_FALSE(termsFor(clouds::forceFieldOf("liquid"), equal).pair.equalReach);
    ForceField both = clouds::forceFieldOf("powder");
    both.materials.push_back(*materialPreset("solid"));
    CHECK(termsFor(both, equal).pair.equalReach);  // both reaches are 1.5 between the two
    both.materials.push_back(*materialPreset("liquid"));
    CHECK_FALSE(termsFor(both, equal).pair.equalReach);
}

TEST_CASE("A single change among the radii is found, wherever threads divide them", "[forces][threads]") {
    const ForceField field = clouds::forceFieldOf("solid");
    for (const std::size_t count : {2U, 3U, 200000U}) {
        for (const std::size_t smaller :
             {std::size_t{1}, count / 3, count / 2 - 1, count / 2, count / 2 + 1, count - 1}) {
            if (smaller == 0 || smaller >= count) continue;
            INFO(smaller << " of " << count);
            Particles particles;
            particles.radius.assign(count, 0.3);
            CHECK(termsFor(field, particles).uniform());
            std::fill_n(particles.radius.begin(), smaller, 0.15);
            const ForceTerms terms = termsFor(field, particles);
            CHECK_FALSE(terms.uniform());
            CHECK(terms.cutoff == cutoffRatio(field.materials) * 0.6);
        }
    }
}

TEST_CASE("Gravity and obstacles add to the pair forces of either method", "[forces]") {
    ForceField field = clouds::forceFieldOf("liquid");
    field.gravity = Vec3(0, -9.8, 0);
    field.obstacles.shapes = {Plane{}};
    Particles particles;
    append(particles, {.position = Vec3(0, 0.1, 0), .mass = 2.0});
    append(particles, {.position = Vec3(5, 3.0, 0), .mass = 2.0});
    for (const ForceMethod method : {ForceMethod::grid, ForceMethod::reference}) {
        ForceEvaluator evaluator(field, method);
        std::vector<Vec3> forces;
        evaluator.evaluatePairs(particles, particles.velocity, forces);
        addExternalForces(field, particles, particles.velocity, 0, particles.count(), forces);
        const Vec3 contact = sumContacts(field.obstacles, {particles.position[0], Vec3::Zero(), 0.15, 2.0}).force;
        CHECK(contact.y() > 0.0);
        CHECK(forces[0].y() == Approx(-19.6 + contact.y()).epsilon(4 * kEps));  // two sums
        CHECK(forces[1] == Vec3(0, -19.6, 0));
    }
}

TEST_CASE("A forgotten list is not used for particles that have exchanged their indices", "[forces]") {
    const ForceField field = clouds::forceFieldOf("solid");
    Particles particles = clouds::strewn(100, 1.0);
    ForceEvaluator evaluator(field, ForceMethod::grid);
    std::vector<Vec3> forces;
    evaluator.evaluatePairs(particles, particles.velocity, forces);
    evaluator.forgetList();
    particles.radius.back() *= 0.5;
    std::swap(particles.position.front(), particles.position.back());
    evaluator.evaluatePairs(particles, particles.velocity, forces);
    CHECK(forces == onGrid(field, particles));
}

TEST_CASE("Whether a particle has a neighbor depends on positions, not on the list that covers them", "[forces]") {
    constexpr double kCutoff = 0.6;
    const ForceField field = clouds::forceFieldOf("liquid");
    Particles particles;
    for (const double x : {0.0, 0.61, 5.0}) append(particles, {.position = Vec3(x, 0, 0)});
    particles.velocity[2] = Vec3(0, 2, 0);
    CHECK(termsFor(field, particles).cutoff == Approx(kCutoff));  // c_d = 2 times the rest length
    std::set<double> reaches;
    for (const double step : {0.0, 0.01}) {
        ForceEvaluator evaluator(field, ForceMethod::grid);
        std::vector<Vec3> forces;
        evaluator.evaluatePairs(particles, particles.velocity, forces);
        particles.position[2].y() += 10.0;  // needs a new list
        evaluator.evaluatePairs(particles, particles.velocity, forces, step);
        reaches.insert(evaluator.list().reach());
        std::vector<Vec3> positions = particles.position;
        // The answer does not depend on the cached neighbor.
        const auto hasNoNeighbor = [&](std::size_t p, std::uint32_t& cachedNeighbor) {
            const bool isNow = evaluator.hasNoNeighbor(positions, particles.radius, p, cachedNeighbor);
            CHECK(evaluator.hasNoNeighbor(positions, particles.radius, p, cachedNeighbor) == isNow);
            return isNow;
        };
        for (const std::uint32_t first : {0U, 1U, 2U, 3U, 0xffffffffU}) {
            INFO("cachedNeighbor " << first);
            std::uint32_t cachedNeighbor = first;
            positions[1].x() = particles.position[1].x();
            for (std::size_t p = 0; p < 3; ++p) CHECK(hasNoNeighbor(p, cachedNeighbor = first));
            positions[1].x() = 0.599;
            CHECK_FALSE(hasNoNeighbor(0, cachedNeighbor = first));
            CHECK(cachedNeighbor == 1);
            CHECK_FALSE(hasNoNeighbor(1, cachedNeighbor = first));
            CHECK(cachedNeighbor == 0);
            CHECK(hasNoNeighbor(2, cachedNeighbor = first));
            CHECK_FALSE(hasNoNeighbor(3, cachedNeighbor = first));  // emitted since, without a row
        }
        positions.push_back(positions[2]);  // emitted right beside it, in no row yet
        std::uint32_t cachedNeighbor = 3;
        CHECK(hasNoNeighbor(2, cachedNeighbor));
    }
    CHECK(reaches.size() == 2);  // without neighbors, the widest skin for any known step
}

TEST_CASE("A particle's neighbors are those that act on it, whatever acts on larger particles", "[forces]") {
    const ForceField field = clouds::forceFieldOf("liquid");  // pairs act up to twice the sum of their radii
    Particles particles;
    for (const double x : {0.0, 0.5, 0.9}) append(particles, {.position = Vec3(x, 0, 0)});
    particles.radius = {0.05, 0.1, 0.15};
    ForceEvaluator evaluator(field, ForceMethod::grid);
    std::vector<Vec3> forces;
    evaluator.evaluatePairs(particles, particles.velocity, forces);
    for (const std::uint32_t first : {0U, 1U, 2U}) {
        std::uint32_t cachedNeighbor = first;
        CHECK(evaluator.hasNoNeighbor(particles.position, particles.radius, 0, cachedNeighbor));
        CHECK_FALSE(evaluator.hasNoNeighbor(particles.position, particles.radius, 1, cachedNeighbor = first));
        CHECK_FALSE(evaluator.hasNoNeighbor(particles.position, particles.radius, 2, cachedNeighbor = first));
    }
}
