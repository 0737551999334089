// Observables that hold a run against the same scene at its reference step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/common/cloud_statistics.h"
#include "studies/common/position_error.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Particles;

constexpr double kDiffers = std::numeric_limits<double>::infinity();

/// Whether the runs can be compared particle by particle in every frame.
bool isComparable(const ObservableInput& trial) {
    return trial.reference != nullptr && trial.reference->frames.size() == trial.run.frames.size() &&
           trial.reference->frames.back().count() == trial.run.frames.back().count();
}

/// The largest difference of a quantity of a frame over all frames that have particles, in radii of the first one.
template <class Quantity>
double largestDifference(const ObservableInput& trial, const Quantity& quantity) {
    if (!isComparable(trial)) return kDiffers;
    double largest = 0.0;
    for (std::size_t k = 0; k < trial.run.frames.size(); ++k) {
        const Particles& ours = trial.run.frames[k];
        const Particles& reference = trial.reference->frames[k];
        if (ours.count() != reference.count()) return kDiffers;
        if (ours.count() > 0) largest = std::max(largest, std::abs(quantity(ours) - quantity(reference)));
    }
    return largest / trial.run.frames.back().radius.front();
}

double front(const Particles& particles) {
    double furthest = -kDiffers;
    for (const engine::Vec3& position : particles.position) furthest = std::max(furthest, position.x());
    return furthest;
}

double fastestRise(const Run& run) {
    double fastest = -kDiffers;
    for (const Particles& frame : run.frames) {
        double momentum = 0.0;
        double mass = 0.0;
        for (std::size_t p = 0; p < frame.count(); ++p) {
            momentum += frame.mass[p] * frame.velocity[p].y();
            mass += frame.mass[p];
        }
        fastest = std::max(fastest, momentum / mass);
    }
    return fastest;
}

}  // namespace

/// Root mean square over the particles at the end, each in its own radii.
double positionError(const ObservableInput& trial) {
    if (!isComparable(trial)) return kDiffers;
    const Particles& ours = trial.run.frames.back();
    return positionError(ours, trial.reference->frames.back(), ours.count()).rms;
}

/// Of the heaviest particle of each frame, over all of them.
double heightError(const ObservableInput& trial) {
    return largestDifference(trial, [](const Particles& frame) {
        const auto heaviest = std::ranges::max_element(frame.mass) - frame.mass.begin();
        return frame.position[static_cast<std::size_t>(heaviest)].y();
    });
}

/// Of the particle furthest along x, over all frames.
double frontError(const ObservableInput& trial) {
    return largestDifference(trial, front);
}

/// Of the radius that holds 90 % of the particles, over all frames.
double radiusError(const ObservableInput& trial) {
    return largestDifference(trial, [](const Particles& frame) { return bulkStatistics(frame).r90; });
}

/// At the end: center of mass, radius of gyration and R90 in units of the reference's R90, z90 in units of itself.
double statisticsError(const ObservableInput& trial) {
    if (!isComparable(trial)) return kDiffers;
    const BulkStatistics ours = bulkStatistics(trial.run.frames.back());
    const BulkStatistics reference = bulkStatistics(trial.reference->frames.back());
    return std::max({(ours.center - reference.center).norm() / reference.r90,
                     std::abs(ours.gyration - reference.gyration) / reference.r90,
                     std::abs(ours.r90 - reference.r90) / reference.r90,
                     std::abs(ours.z90 - reference.z90) / std::abs(reference.z90)});
}

/// Of the fastest rise of the center of mass, as a share of the reference's.
double reboundError(const ObservableInput& trial) {
    if (!isComparable(trial)) return kDiffers;
    return std::abs(fastestRise(trial.run) / fastestRise(*trial.reference) - 1.0);
}

/// Of the speed that a shot is left with, as a share of the reference's: the largest over the particles.
double restitutionError(const ObservableInput& trial) {
    if (!isComparable(trial)) return kDiffers;
    double worst = 0.0;
    for (std::size_t p = 0; p < trial.run.frames.back().count(); ++p) {
        const double ours = trial.run.frames.back().velocity[p].norm();
        const double reference = trial.reference->frames.back().velocity[p].norm();
        worst = std::max(worst, std::abs(ours / reference - 1.0));
    }
    return worst;
}

}  // namespace studies
