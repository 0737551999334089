// Computes the bound on the time step from sums over each particle's pairs and from eigenvalues.
//
// The conservative force of a pair has the stiffness k along n = P/D and -F/D across n. Only positive stiffness limits
// the step, so negative parts count as zero. The damping of a pair is b_d s_d along n and zero across n.
#include "engine/stepping/step_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "engine/forces/pair_sums.h"

namespace engine {
namespace {

struct OwnSums {
    Matrix3 stiffness = Matrix3::Zero();  ///< N/m
    Matrix3 damping = Matrix3::Zero();    ///< kg/s
};

OwnSums sumsOf(const PairTraversal& pairs, std::size_t laneSlot) {
    OwnSums sums;
    const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
    pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
        const auto c = pairs.constants(p, pairs.packed[other]);
        const double distance = std::sqrt(distanceSq);
        const Vec3 normal = separation / distance;
        const Matrix3 along = normal * normal.transpose();
        const double across = -pairCoefficient<kConservative>(distanceSq, 0.0, c);
        sums.stiffness +=
            std::max(0.0, pairStiffness(distance, c)) * along + std::max(0.0, across) * (Matrix3::Identity() - along);
        sums.damping += pairDampingOverSq(distanceSq, c) * distanceSq * along;
    });
    return sums;
}

double largestEigenvalue(const Matrix3& matrix) {
    return Eigen::SelfAdjointEigenSolver<Matrix3>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// The longest stable step (s) of a mode of motion with this squared frequency (1/s^2) and decay rate (1/s); infinite
/// where both are zero. See step_bound.h for the derivation.
double longestStep(StepperKind stepper, double frequencySq, double decay) {
    if (stepper == StepperKind::implicitDamping) return 2.0 / std::sqrt(frequencySq);
    if (stepper == StepperKind::symplecticEuler || stepper == StepperKind::leapfrog)
        return 4.0 / (decay + std::sqrt(decay * decay + 4.0 * frequencySq));
    return 2.0 / (decay + std::sqrt(decay * decay + frequencySq));
}

/// The damping matrix C and the stiffness matrix K of the whole set of particles; neither contains their masses.
struct PairSystem {
    PairMatrix damping;
    PairMatrix stiffness;
    std::vector<double> mass;  ///< mass of each particle in the order of the matrices, kg
};

PairSystem systemOf(const PairTraversal& pairs, const Particles& particles) {
    PairSystem system;
    std::vector<Vec3> forces(particles.count());
    sumPairs(pairs, {.forces = forces, .matrix = &system.damping, .weights = {1.0, 0.0}});
    sumPairs(pairs, {.forces = forces, .matrix = &system.stiffness, .weights = {0.0, 1.0}});
    system.damping.mass.assign(particles.count(), 0.0);
    system.stiffness.mass = system.damping.mass;
    for (const std::uint32_t p : pairs.list.order) system.mass.push_back(particles.mass[p]);
    return system;
}

double dotOf(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return sumOver(a.size(), [&](std::size_t p) { return dot(a[p], b[p]); });
}

/// Improves a bound h on the time step (s). The sums over the pairs of one particle overestimate the eigenvalues, since
/// all its neighbors would have to move against it. Power iteration on M^-1 (h^2 K + 2 h C) finds the mode that really
/// limits the step; the Rayleigh quotients of that mode are its squared frequency and its decay rate.
double refined(const PairTraversal& pairs, const Particles& particles, StepperKind stepper, double h) {
    constexpr int kIterations = 40;  // iterations; chosen: quotients are then accurate to a few percent
    PairSystem system = systemOf(pairs, particles);
    const std::size_t count = particles.count();
    std::vector<Vec3> x(count), kx(count), cx(count), mx(count);
    for (std::size_t p = 0; p < count; ++p) x[p] = randomVector(1, pairs.packed[p].id);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        multiply(system.stiffness, x, kx);
        multiply(system.damping, x, cx);
        for (std::size_t p = 0; p < count; ++p) x[p] = (h * h * kx[p] + 2.0 * h * cx[p]) / system.mass[p];
        const double length = std::sqrt(dotOf(x, x));
        if (!(length > 0.0)) return h;
        for (Vec3& entry : x) entry /= length;
    }
    multiply(system.stiffness, x, kx);
    multiply(system.damping, x, cx);
    for (std::size_t p = 0; p < count; ++p) mx[p] = system.mass[p] * x[p];
    const double inertia = dotOf(x, mx);
    return std::max(h, longestStep(stepper, dotOf(x, kx) / inertia, dotOf(x, cx) / inertia));
}

}  // namespace

std::optional<StepBound> stepBound(const ForceField& field, const Particles& particles, StepperKind stepper) {
    if (particles.count() < 2) return std::nullopt;
    PairTraversal pairs(field, Precision::doubles);
    pairs.prepare(field, particles, particles.velocity);
    std::vector<StepBound> bounds(particles.count());
    pairs.forEachParticle([&](std::size_t laneSlot) {
        const std::size_t p = pairs.list.order[pairs.sortedIndexAt(laneSlot)];
        const OwnSums sums = sumsOf(pairs, laneSlot);
        const double frequencySq = 2.0 * largestEigenvalue(sums.stiffness) / particles.mass[p];
        const double decay = 2.0 * largestEigenvalue(sums.damping) / particles.mass[p];
        const double seconds = longestStep(stepper, frequencySq, decay);
        if (std::isfinite(seconds)) bounds[p] = {seconds, p, decay * decay > 4.0 * frequencySq};
    });
    const auto tightest = std::min_element(
        bounds.begin(), bounds.end(), [](const StepBound& a, const StepBound& b) { return a.seconds < b.seconds; });
    if (!std::isfinite(tightest->seconds)) return std::nullopt;
    StepBound bound = *tightest;
    bound.seconds = refined(pairs, particles, stepper, bound.seconds);
    return bound;
}

}  // namespace engine
