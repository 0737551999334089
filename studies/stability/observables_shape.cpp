// Observables of clusters: whether they hold together, and how closely they pack.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/law/pair_law.h"
#include "engine/state/bodies.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Particles;
using engine::Vec3;

/// The mixed law of two particles.
engine::PairConstants<double> constantsOf(const ObservableInput& trial, std::size_t p, std::size_t i) {
    const Particles& particles = trial.run.frames.back();
    const std::vector<engine::Material>& materials = trial.scene.setup.materials;
    return engine::pairConstants<double>(
        engine::mixed(materials[particles.material[p]], materials[particles.material[i]]),
        particles.radius[p] + particles.radius[i]);
}

/// The first member of a particle's group; shortens the way there for the next time.
std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
}

double meanNearestDistance(const std::vector<Vec3>& positions) {
    double sum = 0.0;
    for (std::size_t p = 0; p < positions.size(); ++p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < positions.size(); ++i)
            if (i != p) nearest = std::min(nearest, (positions[p] - positions[i]).squaredNorm());
        sum += std::sqrt(nearest);
    }
    return sum / static_cast<double>(positions.size());
}

/// The given number of face-centered cubic sites nearest to one of them, neighbors 1 apart.
std::vector<Vec3> roundLattice(std::size_t count) {
    // Two sites to the cube of 2^(1/2): a ball of this radius holds twice as many as are wanted.
    const double radius = 1.0 + std::cbrt(2.0 * static_cast<double>(count) * 3.0 / (4.0 * 3.14159) / std::sqrt(2.0));
    std::vector<Vec3> sites = engine::ballPositions(Vec3::Zero(), radius, {.spacing = 1.0});
    std::stable_sort(sites.begin(), sites.end(),
                     [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < b.squaredNorm(); });
    sites.resize(std::min(count, sites.size()));
    return sites;
}

double latticeEnergy(const std::vector<Vec3>& sites, double spacing, const engine::PairConstants<double>& constants) {
    double sum = 0.0;
    for (std::size_t p = 0; p < sites.size(); ++p)
        for (std::size_t i = 0; i < p; ++i)
            sum += engine::pairEnergy(spacing * (sites[p] - sites[i]).norm(), constants);
    return sum;
}

/// The spacing at which a round lattice of this many particles has the least energy, m.
double predictedSpacing(std::size_t count, const engine::PairConstants<double>& constants) {
    const std::vector<Vec3> sites = roundLattice(count);
    const double restLength = 1.0 / std::sqrt(constants.inverseRestSq);
    constexpr int kPlaces = 200;  // chosen: half a per cent of the rest length apart
    double best = restLength;
    double least = std::numeric_limits<double>::infinity();
    for (int place = 1; place <= kPlaces; ++place) {
        const double spacing = restLength * place / kPlaces;
        const double energy = latticeEnergy(sites, spacing, constants);
        if (energy < least) {
            least = energy;
            best = spacing;
        }
    }
    return best;
}

}  // namespace

/// Particles at the end that hang on to the largest cluster by no chain of pairs within reach of the attraction.
double fragments(const ObservableInput& trial) {
    const Particles& particles = trial.run.frames.back();
    std::vector<std::size_t> parent(particles.count());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    for (std::size_t p = 0; p < particles.count(); ++p)
        for (std::size_t i = 0; i < p; ++i)
            if ((particles.position[p] - particles.position[i]).squaredNorm() < constantsOf(trial, p, i).reachSq)
                parent[rootOf(parent, p)] = rootOf(parent, i);
    std::vector<std::size_t> members(particles.count(), 0);
    for (std::size_t p = 0; p < particles.count(); ++p) ++members[rootOf(parent, p)];
    return static_cast<double>(particles.count() - *std::max_element(members.begin(), members.end()));
}

/// Mean distance to the nearest neighbor at the end, over that in the face-centered cubic ball of as many particles
/// that has the least energy. The particles must be alike.
double spacing(const ObservableInput& trial) {
    const Particles& particles = trial.run.frames.back();
    return meanNearestDistance(particles.position) / predictedSpacing(particles.count(), constantsOf(trial, 0, 0));
}

}  // namespace studies
