// Sums over the links of every particle while it visits them, so that only an implicit exchange, which needs them again
// and again, has to keep them.
#include "engine/heat/heat_network.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/state/probe.h"

namespace engine {
namespace {

constexpr double kReachSq = kConductingReach * kConductingReach;

/// 1 - x^2/1.5^2 of two particles that touch, and of those at the second distance of closest packing.
constexpr double kTouchingWeight = 1.0 - 1.0 / kReachSq;
constexpr double kNextWeight = 1.0 - 2.0 / kReachSq;

/// The weights of all neighbors in closest packing.
constexpr double kAllWeights = 12.0 * kTouchingWeight + 6.0 * kNextWeight;

double weightAt(double distanceRatioSq) {
    return std::max(0.0, 1.0 - distanceRatioSq * (1.0 / kReachSq));
}

/// Conductance over conductivity and rest length, from the weight. In closest packing, where the volume of a particle
/// is D0^3/sqrt(2), x_j^2 sums to 4 D0^2 over the neighbors of either distance.
double conductanceOverRest(double weight) {
    constexpr double kOfLattice = 2.0 * std::numbers::sqrt2 * (kTouchingWeight + kNextWeight);
    return weight * (1.0 / kOfLattice);
}

double harmonicMean(double a, double b) {
    return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

/// Half of the power with which damping and friction of a pair make heat, W.
double halfDissipation(const PackedParticle& p, const PackedParticle& i, const Vec3& separation, double distanceSq,
                       const PairConstants<double>& constants) {
    const Vec3 velocity(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz);
    const double approach = dot(velocity, separation);
    double power = pairDampingOverSq(distanceSq, constants) * approach * approach;
    if (!(constants.friction > 0.0)) return 0.5 * power;
    const double pushOverDistance = pairCoefficient<kConservative>(distanceSq, 0.0, constants);
    if (!(pushOverDistance > 0.0)) return 0.5 * power;  // most neighbors do not touch
    const double slipSq = std::max(0.0, squaredLength(velocity) - approach * approach / distanceSq);
    power += slipDamping(constants.friction, pushOverDistance * std::sqrt(distanceSq), slipSq) * slipSq;
    return 0.5 * power;
}

/// Visits the links of every particle.
class Finder {
 public:
    Finder(const PairTraversal& pairs, const Particles& particles, HeatNetwork& network)
        : pairs_(pairs), particles_(particles), network_(network) {
        for (const Material& material : pairs.materials) conductivity_.push_back(material.thermal.conductivity);
    }

    /// @param temperature  in combined order, K
    /// @param addOutside   addOutside(p, own temperature, cover) adds what p exchanges with obstacles and air
    template <class AddOutside>
    void findFlows(const std::vector<double>& temperature, const AddOutside& addOutside) {
        for (auto* array :
             {&network_.conductanceToOthers, &network_.flowFromOthers, &network_.conductanceOutside, &network_.inflow})
            array->assign(particles_.count(), 0.0);
        forEachOwn([&](std::size_t laneSlot, std::uint32_t p) {
            const double own = temperature[pairs_.list.order[pairs_.sortedIndexAt(laneSlot)]];
            Cover cover;
            double conductances = 0.0;
            double flow = 0.0;
            forEachLink(laneSlot, [&](std::uint32_t other, double conductance, const Neighbor& at) {
                conductances += conductance;
                flow += conductance * (temperature[pairs_.list.order[other]] - own);
                cover.weight += at.weight;
                cover.side += at.weight / std::sqrt(at.distanceSq) * at.separation;
            });
            cover.weight /= kAllWeights;
            cover.side /= kAllWeights;
            network_.conductanceToOthers[p] = conductances;
            network_.flowFromOthers[p] = flow;
            addOutside(p, own, cover);
        });
    }

    void findLinks() {
        countLinks();
        forEachOwn([&](std::size_t laneSlot, std::uint32_t p) {
            std::size_t link = network_.begin[p];
            forEachLink(laneSlot, [&](std::uint32_t other, double conductance, const Neighbor&) {
                network_.other[link] = pairs_.list.order[other];
                network_.conductance[link++] = conductance;
            });
        });
    }

 private:
    /// Where a neighbor is that conducts.
    struct Neighbor {
        const Vec3& separation;  ///< P, m
        double distanceSq;       ///< m^2
        double weight;           ///< 1 - x^2/1.5^2
    };

    void countLinks() {
        network_.begin.assign(particles_.count() + 1, 0);
        forEachOwn([&](std::size_t laneSlot, std::uint32_t p) {
            std::size_t count = 0;
            forEachLink(laneSlot, [&](std::uint32_t, double, const Neighbor&) { ++count; });
            network_.begin[p + 1] = count;
        });
        for (std::size_t p = 0; p < particles_.count(); ++p) network_.begin[p + 1] += network_.begin[p];
        network_.other.resize(network_.begin.back());
        network_.conductance.resize(network_.begin.back());
    }

    template <class Body>
    void forEachOwn(const Body& body) const {
        pairs_.forEachParticle([&](std::size_t laneSlot) {
            const std::uint32_t p = pairs_.order()[pairs_.sortedIndexAt(laneSlot)];
            if (p != kGhost) body(laneSlot, p);
        });
    }

    /// Calls visit(sorted index, conductance in W/K, Neighbor) for the neighbors that conduct.
    template <class Visit>
    void forEachLink(std::size_t laneSlot, const Visit& visit) const {
        const PackedParticle& own = pairs_.packed[pairs_.sortedIndexAt(laneSlot)];
        const double ofOwn = conductivity_[own.material];
        const double reach = kConductingReach * (own.radius + pairs_.terms.largestRadius);
        pairs_.forEachWithin(reach, laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
            const PackedParticle& neighbor = pairs_.packed[other];
            const double rest = own.radius + neighbor.radius;
            const double weight = weightAt(distanceSq / (rest * rest));
            if (!(weight > 0.0)) return;
            const double conductivity = harmonicMean(ofOwn, conductivity_[neighbor.material]);
            visit(other, conductivity * rest * conductanceOverRest(weight), {separation, distanceSq, weight});
        });
    }

    const PairTraversal& pairs_;
    const Particles& particles_;
    HeatNetwork& network_;
    std::vector<double> conductivity_;  ///< of each material, W/(m K)
};

/// Conductance to the air over the free area at this temperature (K), W/(m^2 K). Radiation is that of the temperature
/// at the start: eps sigma (T_air^4 - T^4) = eps sigma (T_air^2 + T^2) (T_air + T) (T_air - T).
double exchangeWithAir(const Air& air, double temperature) {
    const double squares = air.temperature * air.temperature + temperature * temperature;
    return air.exchange + air.emissivity * kStefanBoltzmann * squares * (air.temperature + temperature);
}

/// Share of the full contact between a particle of this radius (m) and a surface at this distance (m) from its center.
double contactShare(double radius, double height) {
    const double ratio = std::max(0.0, height) / radius;
    return std::min(1.0, weightAt(ratio * ratio) / kTouchingWeight);
}

/// Adds what one particle exchanges with the obstacles, which are part of its cover.
void addWalls(const Obstacles& obstacles, const HeatSetup& heat, const Thermal& thermal, const Probe& probe,
              std::size_t p, Cover& cover, HeatNetwork& network) {
    const double reach = kConductingReach * probe.radius;
    forEachSurface(obstacles, probe.position, probe.time, reach, [&](const Surface& surface) {
        if (surface.height >= reach) return;
        // A wall is in the place of three neighbors of either distance in a layer of closest packing.
        const double weight =
            contactShare(probe.radius, surface.height) * (3.0 * kTouchingWeight + 3.0 * kNextWeight) / kAllWeights;
        cover.weight += weight;
        cover.side += weight * (std::numbers::sqrt2 / std::numbers::sqrt3) * surface.normal;
        if (surface.obstacle >= heat.obstacles.size() || !heat.obstacles[surface.obstacle]) return;
        const double conductance = conductanceToWall(thermal.conductivity, probe.radius, surface.height);
        network.conductanceOutside[p] += conductance;
        network.inflow[p] += conductance * *heat.obstacles[surface.obstacle];
    });
}

}  // namespace

double conductanceAt(double distanceRatio) {
    return conductanceOverRest(weightAt(distanceRatio * distanceRatio));
}

double conductanceToWall(double conductivity, double radius, double height) {
    return 2.0 * std::numbers::sqrt3 * conductivity * radius * contactShare(radius, height);
}

double freeArea(double radius, const Cover& cover) {
    // The cover's side in a flat surface of closest packing: three neighbors of either distance are missing, at cosines
    // of sqrt(2/3) and sqrt(1/3).
    constexpr double kFlat =
        (3.0 * kTouchingWeight * 0.816496580927726 + 3.0 * kNextWeight * 0.5773502691896258) / kAllWeights;
    constexpr double kFlatArea = 2.0 * std::numbers::sqrt3;  // in squared radii
    constexpr double kWholeArea = 4.0 * std::numbers::pi;
    const double ofSurface = kFlatArea * std::sqrt(squaredLength(cover.side)) / kFlat;
    const double ofLone = kWholeArea * std::max(0.0, 1.0 - 2.0 * cover.weight);
    return radius * radius * std::min(kWholeArea, std::max(ofSurface, ofLone));
}

void findFlows(const PairTraversal& pairs, const Particles& particles, const Obstacles& obstacles,
               const HeatSetup& heat, const std::vector<double>& temperature, double time, HeatNetwork& network) {
    Finder(pairs, particles, network).findFlows(temperature, [&](std::uint32_t p, double own, Cover& cover) {
        const Thermal& thermal = pairs.materials[particles.material[p]].thermal;
        const Probe probe = probeOf(pairs.materials, particles, p, particles.velocity[p], time);
        if (!obstacles.shapes.empty()) addWalls(obstacles, heat, thermal, probe, p, cover, network);
        const double toAir = exchangeWithAir(heat.air, own);
        if (toAir == 0.0) return;
        const double conductance = toAir * freeArea(probe.radius, cover);
        network.conductanceOutside[p] += conductance;
        network.inflow[p] += conductance * heat.air.temperature;
    });
}

void findLinks(const PairTraversal& pairs, const Particles& particles, HeatNetwork& network) {
    Finder(pairs, particles, network).findLinks();
}

std::vector<double> dissipationOf(const PairTraversal& pairs, const Particles& particles) {
    std::vector<double> powers(particles.count(), 0.0);
    pairs.forEachParticle([&](std::size_t laneSlot) {
        const std::uint32_t p = pairs.order()[pairs.sortedIndexAt(laneSlot)];
        if (p == kGhost) return;
        const PackedParticle& own = pairs.packed[pairs.sortedIndexAt(laneSlot)];
        PairConstants<double> computed;
        double power = 0.0;
        pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
            const PackedParticle& neighbor = pairs.packed[other];
            power += halfDissipation(own, neighbor, separation, distanceSq, pairs.constants(own, neighbor, computed));
        });
        powers[p] = power;
    });
    return powers;
}

}  // namespace engine
