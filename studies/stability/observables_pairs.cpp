// Observables of the pair law and of the clusters that particles form under it: whether the force is the slope of the
// energy, whether clusters hold together, and how closely they pack.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "engine/force_law/pair_law.h"
#include "engine/run/diagnostics.h"
#include "engine/state/bodies.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Particles;
using engine::Vec3;

/// Two particles in empty space, at a variable distance along the x axis.
class Pair {
 public:
    Pair(const engine::Setup& setup, std::uint32_t p, std::uint32_t i)
        : evaluator_({setup.materials, Vec3::Zero(), {}}, setup.forces) {
        for (const std::uint32_t material : {p, i})
            append(particles_, {.radius = setup.materials[material].radius, .material = material});
    }

    double restLength() const { return particles_.radius[0] + particles_.radius[1]; }

    /// Force between the particles at a distance (m), N; positive where they repel each other.
    double force(double distance) {
        particles_.position[1].x() = distance;
        evaluator_.evaluatePairs(particles_, particles_.velocity, forces_);
        return forces_[1].x();
    }

    /// Energy of the pair at a distance (m), J.
    double energy(double distance) {
        particles_.position[1].x() = distance;
        return engine::energy(evaluator_, particles_).pairs;
    }

 private:
    engine::ForceEvaluator evaluator_;
    engine::Particles particles_;
    std::vector<Vec3> forces_;
};

/// Integral of the force of a pair from one distance to another (J), by Gauss-Legendre quadrature with five points,
/// which is exact for polynomials up to degree nine.
double work(Pair& pair, double from, double to) {
    const double outer = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
    const double inner = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
    const double outerWeight = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
    const double innerWeight = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0;
    const std::array<std::array<double, 2>, 5> points = {{{-outer, outerWeight},
                                                          {-inner, innerWeight},
                                                          {0.0, 128.0 / 225.0},
                                                          {inner, innerWeight},
                                                          {outer, outerWeight}}};
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    double sum = 0.0;
    for (const auto& [x, weight] : points) sum += weight * pair.force(middle + half * x);
    return half * sum;
}

/// Largest difference between the energy U(D) of a pair and the work of the force from its reach inward to a distance
/// D, relative to U. Near the reach U is a difference of terms as large as the depth of the well, which is b1/(12 D0^3)
/// for c_r = 2, so the difference is divided by no less than this.
double lawError(Pair& pair, const engine::Material& material) {
    constexpr int kPanels = 60;  // of the integral; chosen: the quadrature errs by 1e-15 on the steepest panel
    const double rest = pair.restLength();
    const double core = material.coreFraction * rest;
    const double floor = material.repulsion / (12.0 * rest * rest * rest);
    double worst = 0.0;
    double distance = material.repulsionReach * rest;
    double sum = 0.0;
    const auto integrateTo = [&](double next) {
        sum += work(pair, next, distance);
        distance = next;
        const double energy = pair.energy(distance);
        worst = std::max(worst, std::abs(sum - energy) / std::max(std::abs(energy), floor));
    };
    const double ratio = std::pow(core / distance, 1.0 / kPanels);
    for (int panel = 1; panel < kPanels; ++panel) integrateTo(distance * ratio);
    // The slope of the force jumps at the core distance, so a panel of the integral ends there.
    integrateTo(core);
    for (const double share : {0.75, 0.5, 0.25, 0.01}) integrateTo(share * core);
    return worst;
}

/// The constants of the pair law of two particles at the end of a run.
engine::PairConstants<double> constantsOf(const ObservableInput& input, std::size_t p, std::size_t i) {
    const Particles& particles = input.run.frames.back();
    const std::vector<engine::Material>& materials = input.scene.setup.materials;
    return engine::pairConstants<double>(
        engine::mixed(materials[particles.material[p]], materials[particles.material[i]]),
        particles.radius[p] + particles.radius[i]);
}

/// The root of the tree of a particle in a union-find forest. Halves the path to the root on the way.
std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
}

/// Mean over all positions of the distance to the nearest other position, m.
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

/// A round piece of a face-centered cubic lattice with neighbors 1 apart: the `count` sites nearest to one of them.
std::vector<Vec3> roundLattice(std::size_t count) {
    // The lattice has sqrt(2) sites per unit volume. A ball of this radius holds more than twice as many as needed.
    const double volume = 2.0 * static_cast<double>(count) / std::numbers::sqrt2;
    const double radius = 1.0 + std::cbrt(volume * 3.0 / (4.0 * std::numbers::pi));
    std::vector<Vec3> sites = engine::ballPositions(Vec3::Zero(), radius, {.spacing = 1.0});
    std::stable_sort(sites.begin(), sites.end(),
                     [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < b.squaredNorm(); });
    sites.resize(std::min(count, sites.size()));
    return sites;
}

/// Sum of the pair energies of particles on a lattice that is scaled to a spacing (m), J.
double latticeEnergy(const std::vector<Vec3>& sites, double spacing, const engine::PairConstants<double>& constants) {
    double sum = 0.0;
    for (std::size_t p = 0; p < sites.size(); ++p)
        for (std::size_t i = 0; i < p; ++i)
            sum += engine::pairEnergy(spacing * (sites[p] - sites[i]).norm(), constants);
    return sum;
}

/// The spacing at which a round piece of a lattice with this number of particles has the least energy, m.
double predictedSpacing(std::size_t count, const engine::PairConstants<double>& constants) {
    const std::vector<Vec3> sites = roundLattice(count);
    const double restLength = 1.0 / std::sqrt(constants.inverseRestSq);
    constexpr int kCandidates = 200;  // chosen: the spacings tried are half a percent of the rest length apart
    double best = restLength;
    double least = std::numeric_limits<double>::infinity();
    for (int candidate = 1; candidate <= kCandidates; ++candidate) {
        const double spacing = restLength * candidate / kCandidates;
        const double energy = latticeEnergy(sites, spacing, constants);
        if (energy < least) {
            least = energy;
            best = spacing;
        }
    }
    return best;
}

}  // namespace

/// Observable: the largest difference between the energy of a pair and the work of its force, relative to the energy,
/// over all pairs of the scene's materials.
double pairLaw(const ObservableInput& input) {
    const std::vector<engine::Material>& materials = input.scene.setup.materials;
    double worst = 0.0;
    for (std::uint32_t p = 0; p < materials.size(); ++p)
        for (std::uint32_t i = 0; i <= p; ++i) {
            Pair pair(input.scene.setup, p, i);
            worst = std::max(worst, lawError(pair, engine::mixed(materials[p], materials[i])));
        }
    return worst;
}

/// Observable: number of particles at the end of a run that no chain of pairs within reach of the attraction connects
/// to the largest cluster.
double fragments(const ObservableInput& input) {
    const Particles& particles = input.run.frames.back();
    std::vector<std::size_t> parent(particles.count());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    for (std::size_t p = 0; p < particles.count(); ++p)
        for (std::size_t i = 0; i < p; ++i)
            if ((particles.position[p] - particles.position[i]).squaredNorm() < constantsOf(input, p, i).reachSq)
                parent[rootOf(parent, p)] = rootOf(parent, i);
    std::vector<std::size_t> members(particles.count(), 0);
    for (std::size_t p = 0; p < particles.count(); ++p) ++members[rootOf(parent, p)];
    return static_cast<double>(particles.count() - *std::max_element(members.begin(), members.end()));
}

/// Observable: mean distance to the nearest neighbor at the end of a run, over the distance of neighbors in a round
/// piece of a face-centered cubic lattice with as many particles and the least energy. All particles must have the same
/// material and radius.
double spacing(const ObservableInput& input) {
    const Particles& particles = input.run.frames.back();
    return meanNearestDistance(particles.position) / predictedSpacing(particles.count(), constantsOf(input, 0, 0));
}

}  // namespace studies
