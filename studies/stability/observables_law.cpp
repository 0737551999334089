// The pair law against its own energy, by quadrature through the same calls as every run.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/run/diagnostics.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Vec3;

/// Two particles alone, along x.
class Pair {
 public:
    Pair(const engine::Setup& setup, std::uint32_t p, std::uint32_t i)
        : evaluator_({setup.materials, Vec3::Zero(), {}}, setup.forces) {
        for (const std::uint32_t material : {p, i})
            append(particles_, {.radius = setup.materials[material].radius, .material = material});
    }

    double restLength() const { return particles_.radius[0] + particles_.radius[1]; }

    /// N, positive where they repel.
    double force(double distance) {
        particles_.position[1].x() = distance;
        evaluator_.evaluate(particles_, particles_.velocity, forces_);
        return forces_[1].x();
    }

    /// J
    double energy(double distance) {
        particles_.position[1].x() = distance;
        return engine::energy(evaluator_, particles_).pairs;
    }

 private:
    engine::ForceEvaluator evaluator_;
    engine::Particles particles_;
    std::vector<Vec3> forces_;
};

/// Gauss-Legendre quadrature of the force over an interval, with five points: exact to the ninth power.
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
    for (const auto& [place, weight] : points) sum += weight * pair.force(middle + half * place);
    return half * sum;
}

/// Largest difference of U and the work of F from the reach inwards, relative to U or, near the reach, to the depth of
/// the well of c_r = 2, b1/(12 D0^3): the terms of U that cancel there are of this size.
double worstOf(Pair& pair, const engine::Material& material) {
    constexpr int kPanels = 60;  // chosen: five points each leave 1e-15 of the steepest panel
    const double rest = pair.restLength();
    const double core = material.coreFraction * rest;
    const double floor = material.repulsion / (12.0 * rest * rest * rest);
    double worst = 0.0;
    double distance = material.repulsionReach * rest;
    double sum = 0.0;
    const auto inwards = [&](double next) {
        sum += work(pair, next, distance);
        distance = next;
        const double energy = pair.energy(distance);
        worst = std::max(worst, std::abs(sum - energy) / std::max(std::abs(energy), floor));
    };
    const double ratio = std::pow(core / distance, 1.0 / kPanels);
    for (int panel = 1; panel < kPanels; ++panel) inwards(distance * ratio);
    // The law bends at the core, so a panel ends there.
    inwards(core);
    for (const double share : {0.75, 0.5, 0.25, 0.01}) inwards(share * core);
    return worst;
}

}  // namespace

/// Over all pairs of the scene's materials, mixed ones included.
double pairLaw(const ObservableInput& trial) {
    const std::vector<engine::Material>& materials = trial.scene.setup.materials;
    double worst = 0.0;
    for (std::uint32_t p = 0; p < materials.size(); ++p)
        for (std::uint32_t i = 0; i <= p; ++i) {
            Pair pair(trial.scene.setup, p, i);
            worst = std::max(worst, worstOf(pair, engine::mixed(materials[p], materials[i])));
        }
    return worst;
}

}  // namespace studies
