// Explicit and implicit exchange of heat. The backward Euler method finds enthalpies H with
//   H_p = H0_p + dt (sum_i k_pi (T_i - T_p) + inflow_p - k_out T_p),   T = T(H),
// by Newton's method. T(H) is piecewise linear, so that its iterations are the solutions of linear systems until every
// particle is on the right piece. Each ends with the enthalpies that the flows at the new temperatures give, so that
// heat is kept to rounding, however well the system was solved.
#include "engine/heat/heat_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace engine {
namespace {

/// Largest difference of a particle's temperature from that at which its heat has flowed, K. Chosen: far below what any
/// scene shows.
constexpr double kTolerance = 1e-6;

/// Squared share of the right-hand side's norm that the solver leaves over. Chosen: far below the tolerance above.
constexpr double kResidualSq = 1e-20;

/// Most iterations of Newton's method before the time is halved, and most halvings. Chosen: a front that passes a layer
/// in a step takes about one iteration a layer.
constexpr int kMostNewton = 25;
constexpr int kMostHalvings = 6;

/// The particles as heat sees them.
class HeatBodies {
 public:
    HeatBodies(const std::vector<Material>& materials, Particles& particles)
        : materials_(materials), particles_(particles) {}

    std::size_t count() const { return particles_.count(); }
    double& enthalpy(std::size_t p) const { return particles_.enthalpy[p]; }
    double temperature(std::size_t p) const { return temperatureOf(materials_, particles_, p); }

    /// dT/dH, K/J.
    double warmingOf(std::size_t p) const {
        return warming(thermal(p), particles_.enthalpy[p] / particles_.mass[p]) / particles_.mass[p];
    }

 private:
    const Thermal& thermal(std::size_t p) const { return materials_[particles_.material[p]].thermal; }

    const std::vector<Material>& materials_;
    Particles& particles_;
};

class Exchange {
 public:
    Exchange(const HeatNetwork& network, const HeatBodies& bodies, const Ranks& ranks, const ShareNumbers& share,
             HeatScratch& scratch)
        : network_(network), bodies_(bodies), ranks_(ranks), share_(share), scratch_(scratch) {}

    /// Both return the heat from outside, J.
    double explicitly(double seconds) {
        remember();
        findTemperatures();
        return flow(seconds);
    }

    double implicitly(double seconds) { return implicitly(seconds, kMostHalvings); }

 private:
    void findTemperatures() {
        scratch_.temperature.resize(bodies_.count());
        inParallel(bodies_.count(), kParticleGrain,
                   [&](std::size_t p) { scratch_.temperature[p] = bodies_.temperature(p); });
    }

    /// Sets enthalpies to those before plus what flows at the temperatures in scratch; returns the heat from outside.
    double flow(double seconds) {
        shareTemperatures();
        return exactSum(ranks_, bodies_.count(), [&](std::size_t p) {
            const double fromOutside = flowFromOutside(p);
            bodies_.enthalpy(p) = scratch_.before[p] + seconds * (flowFromOthers(p) + fromOutside);
            return seconds * fromOutside;
        });
    }

    void shareTemperatures() {
        if (network_.hasLinks()) share_(scratch_.temperature, scratch_.combined);
    }

    /// Heat that flows into a particle from others at the temperatures in scratch, W. Without links, these are the ones
    /// that the network was found at.
    double flowFromOthers(std::size_t p) const {
        if (!network_.hasLinks()) return network_.flowFromOthers[p];
        double flow = 0.0;
        for (std::size_t link = network_.begin[p]; link < network_.begin[p + 1]; ++link)
            flow += network_.conductance[link] * (scratch_.combined[network_.other[link]] - scratch_.temperature[p]);
        return flow;
    }

    /// Heat that flows into it from obstacles and air, W.
    double flowFromOutside(std::size_t p) const {
        return network_.inflow[p] - network_.conductanceOutside[p] * scratch_.temperature[p];
    }

    void remember() {
        scratch_.before.resize(bodies_.count());
        inParallel(bodies_.count(), kParticleGrain, [&](std::size_t p) { scratch_.before[p] = bodies_.enthalpy(p); });
    }

    double implicitly(double seconds, int halvings) {
        remember();
        const std::vector<double> start = scratch_.before;
        for (int iteration = 1; iteration <= kMostNewton; ++iteration) {
            findTemperatures();
            findMissing(seconds);
            solveForChange(seconds);
            inParallel(bodies_.count(), kParticleGrain,
                       [&](std::size_t p) { scratch_.temperature[p] += scratch_.change[p]; });
            const double given = flow(seconds);
            if (areConsistent() || (iteration == kMostNewton && halvings == 0)) return given;
        }
        for (std::size_t p = 0; p < bodies_.count(); ++p) bodies_.enthalpy(p) = start[p];
        const double first = implicitly(0.5 * seconds, halvings - 1);
        return first + implicitly(0.5 * seconds, halvings - 1);
    }

    /// Finds what of their heat the present temperatures do not account for.
    void findMissing(double seconds) {
        shareTemperatures();
        scratch_.missing.resize(bodies_.count());
        inParallel(bodies_.count(), kParticleGrain, [&](std::size_t p) {
            const double flowed = seconds * (flowFromOthers(p) + flowFromOutside(p));
            scratch_.missing[p] = scratch_.before[p] + flowed - bodies_.enthalpy(p);
        });
    }

    /// Whether the enthalpies have the temperatures at which heat has flowed.
    bool areConsistent() const {
        const double largest = largestOver(
            bodies_.count(), [&](std::size_t p) { return std::abs(bodies_.temperature(p) - scratch_.temperature[p]); });
        return largestOfAll(ranks_, largest) <= kTolerance;
    }

    /// Solves for the change of the temperatures of all particles but those that melt at one temperature.
    void solveForChange(double seconds) {
        const std::size_t count = bodies_.count();
        std::vector<double>& capacity = scratch_.capacity;
        std::vector<double>& diagonal = scratch_.diagonal;
        capacity.resize(count);
        diagonal.resize(count);
        inParallel(count, kParticleGrain, [&](std::size_t p) {
            const double warming = bodies_.warmingOf(p);
            capacity[p] = warming > 0.0 ? 1.0 / warming : 0.0;
            diagonal[p] = capacity[p] + seconds * (network_.conductanceToOthers[p] + network_.conductanceOutside[p]);
            if (capacity[p] == 0.0) {
                diagonal[p] = 1.0;
                scratch_.missing[p] = 0.0;
            }
        });
        const auto multiply = [&](const std::vector<double>& x, std::vector<double>& product) {
            share_(x, scratch_.combined);
            product.resize(count);
            inParallel(count, kParticleGrain, [&](std::size_t p) {
                product[p] = 0.0;
                if (capacity[p] == 0.0) return;
                double sum = diagonal[p] * x[p];
                for (std::size_t link = network_.begin[p]; link < network_.begin[p + 1]; ++link)
                    sum -= seconds * network_.conductance[link] * scratch_.combined[network_.other[link]];
                product[p] = sum;
            });
        };
        const auto target = [](double norm) { return kResidualSq * norm; };
        solveByGradients(ranks_, scratch_.missing, diagonal, multiply, target, scratch_.change, scratch_.gradients);
    }

    const HeatNetwork& network_;
    const HeatBodies& bodies_;
    const Ranks& ranks_;
    const ShareNumbers& share_;
    HeatScratch& scratch_;
};

}  // namespace

double temperatureOf(const std::vector<Material>& materials, const Particles& particles, std::size_t p) {
    return temperatureAt(materials[particles.material[p]].thermal, particles.enthalpy[p] / particles.mass[p]);
}

bool isExplicit(const HeatNetwork& network, const std::vector<Material>& materials, const Ranks& ranks, double seconds,
                const Particles& particles) {
    const double rate = largestOver(particles.count(), [&](std::size_t p) {
        const double capacity = particles.mass[p] * materials[particles.material[p]].thermal.capacity;
        return (network.conductanceToOthers[p] + network.conductanceOutside[p]) / capacity;
    });
    return seconds * largestOfAll(ranks, rate) <= kExplicitShare;
}

double exchangeHeat(const HeatNetwork& network, const std::vector<Material>& materials, const Ranks& ranks,
                    const ShareNumbers& share, double seconds, Particles& particles, HeatScratch& scratch) {
    const HeatBodies bodies(materials, particles);
    Exchange exchange(network, bodies, ranks, share, scratch);
    return isExplicit(network, materials, ranks, seconds, particles) ? exchange.explicitly(seconds)
                                                                     : exchange.implicitly(seconds);
}

}  // namespace engine
