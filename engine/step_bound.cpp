// Each particle's own sums, and the eigenvalues that bound the step.
//
// The pair's conservative part has stiffness k along n = P/D and -F/D across it; only what stiffens limits the step, so
// negative parts count as zero. Its damping has b_d s_d along n and nothing across.
#include "engine/step_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/pair_traversal.h"

namespace engine {
namespace {

struct OwnSums {
    Matrix3 stiffness = Matrix3::Zero();  ///< N/m
    Matrix3 damping = Matrix3::Zero();    ///< kg/s
};

OwnSums sumsOf(const PairTraversal& pairs, std::uint32_t self) {
    OwnSums sums;
    const PairRecord& p = pairs.records[self];
    pairs.forEachNeighbour(self, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
        const auto c = pairs.constants<false>(p, pairs.records[other]);
        const double distance = std::sqrt(distanceSq);
        const Vec3 normal = separation / distance;
        const Matrix3 along = normal * normal.transpose();
        const double across = -pairCoefficient<PairTerms{true, false}>(distanceSq, 0.0, c);
        sums.stiffness +=
            std::max(0.0, pairStiffness(distance, c)) * along + std::max(0.0, across) * (Matrix3::Identity() - along);
        sums.damping += pairDampingOverSq(distanceSq, c) * distanceSq * along;
    });
    return sums;
}

double largestEigenvalue(const Matrix3& matrix) {
    return Eigen::SelfAdjointEigenSolver<Matrix3>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// The step at which a mode with this squared frequency (1/s^2) and decay (1/s) stops being damped; infinite without
/// either.
double longestStep(StepperKind stepper, double frequencySq, double decay) {
    if (stepper == StepperKind::symplecticEuler) return 4.0 / (decay + std::sqrt(decay * decay + 4.0 * frequencySq));
    return 2.0 / (decay + std::sqrt(decay * decay + frequencySq));
}

}  // namespace

std::optional<StepBound> stepBound(const ForceLaw& law, const Particles& particles, StepperKind stepper) {
    if (particles.count() < 2) return std::nullopt;
    PairTraversal pairs(law);
    pairs.prepare(law, particles, particles.velocity);
    std::vector<StepBound> bounds(particles.count());
    pairs.forEachParticle([&](std::uint32_t self) {
        const std::size_t p = pairs.list.order[self];
        const OwnSums sums = sumsOf(pairs, self);
        const double frequencySq = 2.0 * largestEigenvalue(sums.stiffness) / particles.mass[p];
        const double decay = 2.0 * largestEigenvalue(sums.damping) / particles.mass[p];
        const double seconds = longestStep(stepper, frequencySq, decay);
        if (std::isfinite(seconds)) bounds[p] = {seconds, p, decay * decay > 4.0 * frequencySq};
    });
    const auto tightest = std::min_element(
        bounds.begin(), bounds.end(), [](const StepBound& a, const StepBound& b) { return a.seconds < b.seconds; });
    if (!std::isfinite(tightest->seconds)) return std::nullopt;
    return *tightest;
}

}  // namespace engine
