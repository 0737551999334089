// The implicit steppers' matrix against the same matrix written out, and the promises of its solver.
#include "engine/forces/pair_matrix.h"

#include <Eigen/Dense>
#include "tests/catch.h"

#include "engine/forces/conjugate_gradient.h"
#include "tests/engine/clouds.h"
#include "tests/engine/rounding.h"

using namespace engine;

namespace {

/// Larger weights than most steps have: the pairs outweigh the mass by far.
constexpr MatrixWeights kStrong{.damping = 0.3, .stiffness = 1e-3};

/// Particles with their matrix, and the same matrix written out in the order of particle indices.
struct Case {
    ForceField field;
    Particles particles;
    MatrixWeights weights;
    mutable PairMatrix matrix = {};  ///< a product stores its factor in matrix.packed
    std::vector<std::uint32_t> order = {};
    Eigen::MatrixXd dense = {};
    Eigen::MatrixXd scale = {};  ///< the same sums over absolute values

    Case(ForceField someField, Particles some, MatrixWeights someWeights)
        : field(std::move(someField)), particles(std::move(some)), weights(someWeights) {
        ForceEvaluator evaluator(field, ForceMethod::grid);
        std::vector<Vec3> forces;
        evaluator.assemble(particles, weights, forces, matrix);
        order = evaluator.order();
        writeOut();
    }

    std::size_t count() const { return particles.count(); }

 private:
    void writeOut() {
        const auto size = static_cast<Eigen::Index>(3 * count());
        dense = scale = Eigen::MatrixXd::Zero(size, size);
        for (std::size_t p = 0; p < count(); ++p) {
            add(p, p, particles.mass[p] * Matrix3::Identity());
            for (std::size_t i = 0; i < p; ++i) {
                const Matrix3 block = blockOf(p, i);
                add(p, p, block);
                add(i, i, block);
                add(p, i, -block);
                add(i, p, -block);
            }
        }
    }

    void add(std::size_t row, std::size_t column, const Matrix3& block) {
        const auto r = static_cast<Eigen::Index>(3 * row);
        const auto c = static_cast<Eigen::Index>(3 * column);
        dense.block<3, 3>(r, c) += block;
        scale.block<3, 3>(r, c) += block.cwiseAbs();
    }

    Matrix3 blockOf(std::size_t p, std::size_t i) const {
        const Vec3 separation = particles.position[p] - particles.position[i];
        const double distanceSq = squaredLength(separation);
        const Material material = mixed(field.materials[particles.material[p]], field.materials[particles.material[i]]);
        const auto constants = pairConstants<double>(material, particles.radius[p] + particles.radius[i]);
        const double stiffness = std::max(0.0, pairStiffness(std::sqrt(distanceSq), constants));
        const Matrix3 projection = separation * separation.transpose() / distanceSq;
        const double along =
            weights.damping * pairDampingOverSq(distanceSq, constants) * distanceSq + weights.stiffness * stiffness;
        const Vec3 velocity = particles.velocity[p] - particles.velocity[i];
        const double force =
            std::sqrt(distanceSq) * pairCoefficient<PairTerms{true, false}>(distanceSq, 0.0, constants);
        const double across =
            weights.damping * slipDamping(constants.friction, force, squaredLength(velocity - projection * velocity));
        return along * projection + across * (Matrix3::Identity() - projection);
    }
};

std::vector<Vec3> randomVectors(std::size_t count, std::uint64_t seed) {
    std::vector<Vec3> vectors;
    for (std::size_t p = 0; p < count; ++p) vectors.push_back(clouds::randomVector(seed, p));
    return vectors;
}

/// Vectors in the order of the matrix as one column in the order of the particles.
Eigen::VectorXd column(const Case& c, const std::vector<Vec3>& byPlace) {
    Eigen::VectorXd all(static_cast<Eigen::Index>(3 * c.count()));
    for (std::size_t sortedIndex = 0; sortedIndex < c.count(); ++sortedIndex)
        all.segment<3>(static_cast<Eigen::Index>(3 * c.order[sortedIndex])) = byPlace[sortedIndex];
    return all;
}

/// Square root of the sum of a_p . a_p / m_p, the norm of the solver's tolerance.
double inInverseMass(const Case& c, const std::vector<Vec3>& a) {
    double sum = 0.0;
    for (std::size_t sortedIndex = 0; sortedIndex < c.count(); ++sortedIndex)
        sum += squaredLength(a[sortedIndex]) / c.matrix.mass[sortedIndex];
    return std::sqrt(sum);
}

Case liquidAndSolid() {
    ForceField field;
    field.materials = {*materialPreset("liquid"), *materialPreset("solid")};
    Particles particles = clouds::strewnUnequal(40, 0.5);
    for (std::size_t p = 0; p < particles.count(); ++p) particles.material[p] = static_cast<std::uint32_t>(p % 2);
    return {field, particles, kStrong};
}

std::vector<Case> smallClouds() {
    std::vector<Case> cases = {liquidAndSolid()};
    for (const char* preset : {"liquid", "solid", "powder"}) {
        const MatrixWeights usual{.damping = 0.01, .stiffness = 0.0};
        cases.emplace_back(clouds::forceFieldOf(preset), clouds::strewn(40, 0.5), kStrong);
        cases.emplace_back(clouds::forceFieldOf(preset), clouds::strewnUnequal(40, 0.5), usual);
    }
    return cases;
}

/// With cases that have friction, which does not conserve angular momentum.
std::vector<Case> smallCloudsAndSand() {
    std::vector<Case> cases = smallClouds();
    cases.emplace_back(clouds::forceFieldOf("sand"), clouds::strewn(40, 0.4), kStrong);
    cases.emplace_back(clouds::forceFieldOf("sand"), clouds::strewnUnequal(40, 0.4), kStrong);
    cases.emplace_back(clouds::forceFieldOf("mud"), clouds::strewn(40, 0.5), kStrong);
    return cases;
}

}  // namespace

TEST_CASE("A product equals that of the matrix written out", "[pair-matrix]") {
    for (const Case& c : smallCloudsAndSand()) {
        const auto x = randomVectors(c.count(), 21);
        std::vector<Vec3> product;
        multiply(c.matrix, x, product);
        const Eigen::VectorXd actual = column(c, product);
        const Eigen::VectorXd expected = c.dense * column(c, x);
        const Eigen::VectorXd size = c.scale * column(c, x).cwiseAbs();
        for (Eigen::Index k = 0; k < expected.size(); ++k) {
            // Two orders of summing 120 products, each with a dozen roundings.
            INFO("component " << k << ": " << actual[k] << " against " << expected[k]);
            CHECK(std::abs(actual[k] - expected[k]) <= (2 * 120 + 32) * kEps * size[k]);
        }
    }
}

TEST_CASE("The matrix is symmetric and at least the mass", "[pair-matrix]") {
    for (const Case& c : smallCloudsAndSand()) {
        const auto x = randomVectors(c.count(), 22);
        const auto y = randomVectors(c.count(), 23);
        std::vector<Vec3> ax, ay;
        multiply(c.matrix, x, ax);
        multiply(c.matrix, y, ay);
        const double xay = column(c, x).dot(column(c, ay));
        const double size = column(c, x).cwiseAbs().dot(c.scale * column(c, y).cwiseAbs());
        CHECK(std::abs(xay - column(c, y).dot(column(c, ax))) <=
              500 * kEps * size);  // sums of 120 and 120 terms, twice
        double mass = 0.0;
        for (std::size_t sortedIndex = 0; sortedIndex < c.count(); ++sortedIndex)
            mass += c.matrix.mass[sortedIndex] * squaredLength(x[sortedIndex]);
        CHECK(column(c, x).dot(column(c, ax)) > mass);  // some pair of the cloud resists a random motion
    }
}

TEST_CASE("The two entries of a pair are equal bit for bit", "[pair-matrix]") {
    for (const Case& c : smallCloudsAndSand()) {
        const NeighborRows& rows = c.matrix.rows;
        std::vector<std::size_t> laneSlotOf(c.count());
        for (std::size_t laneSlot = 0; laneSlot < c.count(); ++laneSlot)
            laneSlotOf[static_cast<std::size_t>(rows.ownIndices[laneSlot])] = laneSlot;
        const auto entry = [&](const PairMatrix::Entries& entries, std::size_t laneSlot, std::size_t k) {
            return entries[NeighborRows::blockOf(laneSlot)][rows.at(laneSlot, k)];
        };
        std::size_t pairs = 0;
        for (std::size_t p = 0; p < c.count(); ++p)
            for (std::uint32_t k = 0; k < rows.length[p]; ++k) {
                const std::size_t i = laneSlotOf[rows.sortedIndexAt(p, k)];
                std::uint32_t twin = 0;
                REQUIRE(rows.length[i] > 0);
                while (rows.sortedIndexAt(i, twin) != static_cast<std::uint32_t>(rows.ownIndices[p]))
                    REQUIRE(++twin < rows.length[i]);
                CHECK(entry(c.matrix.along, i, twin) == entry(c.matrix.along, p, k));
                if (!c.matrix.across.empty()) CHECK(entry(c.matrix.across, i, twin) == entry(c.matrix.across, p, k));
                ++pairs;
            }
        CHECK(pairs > c.count());
    }
}

TEST_CASE("Coincident particles leave the matrix symmetric and add nothing to it", "[pair-matrix][threads]") {
    Particles particles = clouds::strewn(200, 0.7);
    particles.position[150] = particles.position[20];
    for (const auto& [preset, precision] : {std::pair{"solid", Precision::doubles},
                                            {"solid", Precision::singles},
                                            {"sand", Precision::doubles},
                                            {"sand", Precision::singles}}) {
        ForceEvaluator evaluator(clouds::forceFieldOf(preset), ForceMethod::grid, precision);
        PairMatrix matrix;
        std::vector<Vec3> forces, product;
        evaluator.assemble(particles, kStrong, forces, matrix);
        CHECK((forces[150] - forces[20]).norm() > 0.0);  // they are separated
        const auto x = randomVectors(particles.count(), 27);
        multiply(matrix, x, product);
        Vec3 sum = Vec3::Zero();
        double size = 0.0;
        for (std::size_t sortedIndex = 0; sortedIndex < x.size(); ++sortedIndex) {
            sum += product[sortedIndex] - matrix.mass[sortedIndex] * x[sortedIndex];
            size += product[sortedIndex].norm();
        }
        CHECK(sum.norm() <= 200 * kEps * size);  // the pairs' impulses cancel, to the rounding of 200 sums
    }
}

TEST_CASE("A solution is off by no more than the tolerance", "[pair-matrix]") {
    // A >= M, so the error x - x* = A^-1 r in the norm of M is at most r in the norm of M^-1, which the solver bounds
    // by the tolerance, relative or absolute. Its residual is a recurrence: at 1e-12 rounding makes up half of it.
    for (const Case& c : smallClouds()) {
        const auto b = randomVectors(c.count(), 24);
        const Eigen::VectorXd exact = c.dense.ldlt().solve(column(c, b));
        for (const double share : {1e-2, 1e-6, 1e-12}) {
            const double size = inInverseMass(c, b);
            for (const Tolerance& tolerance : {Tolerance{share, 0.0}, Tolerance{0.0, share * size}}) {
                std::vector<Vec3> x;
                SolverScratch scratch;
                CHECK(solve(c.matrix, b, tolerance, x, scratch) < 500);
                Eigen::VectorXd error = column(c, x) - exact;
                for (std::size_t p = 0; p < c.count(); ++p)
                    error.segment<3>(static_cast<Eigen::Index>(3 * p)) *= std::sqrt(c.particles.mass[p]);
                CHECK(error.norm() <= 2.0 * share * size);  // derived above
            }
        }
    }
}

TEST_CASE("Impulses of pairs conserve linear and angular momentum at any tolerance", "[pair-matrix]") {
    for (const Case& c : smallClouds()) {
        const auto y = randomVectors(c.count(), 25);
        std::vector<Vec3> b;
        multiply(c.matrix, y, b);
        for (std::size_t sortedIndex = 0; sortedIndex < c.count(); ++sortedIndex)
            b[sortedIndex] -= c.matrix.mass[sortedIndex] * y[sortedIndex];
        for (double tolerance = 0.1; tolerance > 0.5e-12; tolerance *= 0.1) {
            std::vector<Vec3> x;
            SolverScratch scratch;
            solve(c.matrix, b, {tolerance, 0.0}, x, scratch);
            Vec3 momentum = Vec3::Zero();
            Vec3 spin = Vec3::Zero();
            double size = 0.0;
            for (std::size_t sortedIndex = 0; sortedIndex < c.count(); ++sortedIndex) {
                const Vec3 impulse = c.matrix.mass[sortedIndex] * x[sortedIndex];
                momentum += impulse;
                spin += c.particles.position[c.order[sortedIndex]].cross(impulse);
                size += b[sortedIndex].norm();
            }
            CHECK(size > 0.0);
            CHECK(momentum.norm() <= 100 * kEps * size);  // a rounding of the impulses of 100 products, at random signs
            CHECK(spin.norm() <= 100 * kEps * size);      // the same, at arms below 1 m
        }
    }
}

TEST_CASE("A smaller tolerance takes more products", "[pair-matrix]") {
    for (const Case& c : smallClouds()) {
        int before = 0;
        for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12}) {
            std::vector<Vec3> x;
            SolverScratch scratch;
            const int products = solve(c.matrix, randomVectors(c.count(), 26), {tolerance, 0.0}, x, scratch);
            CHECK(products > before);
            before = products;
        }
    }
}

TEST_CASE("A solution ends at the tolerance that is met first", "[pair-matrix]") {
    for (const Case& c : smallClouds()) {
        const auto b = randomVectors(c.count(), 26);
        const double size = inInverseMass(c, b);
        const auto products = [&](const Tolerance& tolerance) {
            std::vector<Vec3> x;
            SolverScratch scratch;
            return solve(c.matrix, b, tolerance, x, scratch);
        };
        CHECK(products({1e-9, 1e-3 * size}) == products({0.0, 1e-3 * size}));
        CHECK(products({1e-3, 1e-9 * size}) == products({1e-3, 0.0}));
        CHECK(products({1e-9, 2.0 * size}) == products({kMostLeftOut, 0.0}));
    }
}

TEST_CASE("Systems of no particles, of one and with a right-hand side of zero", "[pair-matrix]") {
    SolverScratch scratch;
    std::vector<Vec3> x;
    const Case none(clouds::forceFieldOf("solid"), {}, kStrong);
    solve(none.matrix, {}, {1e-6, 0.0}, x, scratch);
    CHECK(x.empty());
    const Case one(clouds::forceFieldOf("solid"), clouds::strewnUnequal(1, 1.0), kStrong);
    CHECK(solve(one.matrix, {Vec3(1, -2, 3)}, {1e-6, 0.0}, x, scratch) == 1);
    CHECK((x[0] - Vec3(1, -2, 3) / one.particles.mass[0]).norm() <=
          4 * kEps * x[0].norm());  // two divisions, a product
    const Case some = liquidAndSolid();
    solve(some.matrix, std::vector<Vec3>(some.count(), Vec3::Zero()), {1e-6, 0.0}, x, scratch);
    CHECK(x == std::vector<Vec3>(some.count(), Vec3::Zero()));
}

TEST_CASE("A solution has the same bits for any number of threads", "[pair-matrix][threads]") {
    const ForceField field = clouds::forceFieldOf("liquid");
    const Particles particles = clouds::strewnUnequal(3000, 2.2);
    const auto solution = [&] {
        ForceEvaluator evaluator(field, ForceMethod::grid);
        PairMatrix matrix;
        SolverScratch scratch;
        std::vector<Vec3> forces, x;
        evaluator.assemble(particles, {.damping = 0.01, .stiffness = 1e-4}, forces, matrix);
        solve(matrix, forces, {1e-8, 0.0}, x, scratch);
        return x;
    };
    const auto expected = solution();
    for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
        std::vector<Vec3> x;
        clouds::onThreads(threads, [&] { x = solution(); });
        CHECK(x == expected);
    }
}
