// The pull and the repulsion of a material with a surface tension.
//
// Tension. To part a liquid along a plane takes the energy of all pairs across the plane, and makes two surfaces. With
// n particles in a unit of volume, n |D_z| / 2 pairs for each separation D cross a unit of area whose normal is z, and
// the mean of |D_z| over all directions is D/2. Hence
//     sigma = -(n/8) sum_j D_j U(D_j),
// over the neighbors j of one particle. For a liquid without structure the sum is an integral, and by parts
// sigma = (pi/8) n^2 integral D^4 U'(D) dD, the formula of Fowler and of Kirkwood and Buff. The surface of a drop then
// arranges itself in a way that takes less energy; kRelaxation is the measured share that is left.
//
// Density. The lattice with nearest neighbors D0 apart is to have no pressure, sum_j D_j F(D_j) = 0 (compression.cpp).
// The pull alone would draw it together, and the repulsion of equation 2 ends at D0. So that a balance is possible, the
// repulsion has the rest length lambda D0 instead, with a rest ratio lambda above 1. The lattice then needs
//     b1 = B(lambda) kappa D0^5,   sigma = T(lambda) kappa,
// with B and T from the sums above for kappa = D0 = 1. B falls with lambda: what repels from further away has to be
// less strong. A given b1 and sigma therefore have one lambda. It is at most kMostRestRatio; what would need more gets
// a larger b1 instead.
#include "engine/force_law/cohesion.h"

#include <algorithm>
#include <cmath>

#include "engine/force_law/lattice.h"
#include "engine/force_law/pair_law.h"

namespace engine {
namespace {

/// Largest rest ratio. Chosen: the softer the repulsion, the less a drop is a crystal, and the longer the steps; but
/// small drops, whose particles have few neighbors that pull, are looser. A cube of 1000 particles of oil and 10 N/m
/// has a shape sum x^4 / sum r^4 (cube .474, ball .600) of .564, .575 and .584 after 4 s at a ratio of 1.3, 1.4
/// and 1.6. At 1.6 a drop of 19 particles of molten metal and 60 N/m bursts.
constexpr double kMostRestRatio = 1.4;

/// Surface tension of drops over that of the lattice. Measured: the energies of drops of 1000 and 5000 particles at
/// rest are those of a bulk and a surface of 0.81, 0.80 and 0.78 times the lattice's tension at rest ratios
/// of 1.15, 1.3 and 1.4; their pressure is 2 sigma/R with 0.78 and 0.79.
constexpr double kRelaxation = 0.78;

/// How often an interval of rest ratios is halved: until it is no wider than rounding.
constexpr int kHalvings = 60;

double fifthPower(double number) {
    return number * number * (number * number) * number;
}

/// Sums over the lattice with nearest neighbors D0 apart, for D0 = 1.
struct LatticeSums {
    double virial = 0.0;   ///< sum of D F(D)
    double tension = 0.0;  ///< see above
};

LatticeSums sumsOf(const Material& material) {
    const PairConstants<double> law = pairConstants<double>(material, 1.0);
    LatticeSums sums;
    sums.virial = sumOverShells(1.0, law.cutoffSq, [&](double count, double distanceSq) {
        return count * distanceSq * pairCoefficient<kConservative>(distanceSq, 0.0, law);
    });
    const double energies = sumOverShells(1.0, law.cutoffSq, [&](double count, double distanceSq) {
        const double distance = std::sqrt(distanceSq);
        return count * distance * pairEnergy(distance, law);
    });
    sums.tension = -energies / (8.0 * cellVolume(1.0));
    return sums;
}

/// b1 and kappa with which a material of unit tension keeps its density, for a rest length of 1.
struct Balance {
    double repulsion = 0.0;
    double pull = 0.0;
};

/// The balance at a rest ratio; nothing if the repulsion begins too near to the rest length for any.
std::optional<Balance> balanceAt(const Material& material, double restRatio) {
    Material repelling = material;
    repelling.restRatio = restRatio;
    repelling.repulsion = 1.0;
    repelling.pull = 0.0;
    Material pulling = repelling;
    pulling.repulsion = 0.0;
    pulling.pull = 1.0;
    const LatticeSums ofRepulsion = sumsOf(repelling);
    const LatticeSums ofPull = sumsOf(pulling);
    if (ofRepulsion.virial <= 0.0) return std::nullopt;
    const double repulsion = -ofPull.virial / ofRepulsion.virial;
    const double tension = kRelaxation * (ofPull.tension + repulsion * ofRepulsion.tension);
    if (tension <= 0.0) return std::nullopt;
    return Balance{repulsion / tension, 1.0 / tension};
}

}  // namespace

std::optional<Material> withCohesion(const Material& material, double cohesion) {
    Material result = material;
    result.cohesion = cohesion;
    result.pull = 0.0;
    result.restRatio = 1.0;
    if (cohesion == 0.0) return result;
    std::optional<Balance> balance = balanceAt(material, kMostRestRatio);
    if (material.repulsionReach > kMostCohesiveReach || !balance) return std::nullopt;
    if (surfaceTension(result) >= cohesion) return result;
    const double unit = cohesion * fifthPower(2.0 * material.radius);
    double tight = 1.0;
    double loose = kMostRestRatio;
    // Where even the largest ratio needs more than the given b1, every halving goes to that side.
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (tight + loose);
        const std::optional<Balance> there = balanceAt(material, middle);
        if (there && there->repulsion * unit <= material.repulsion) {
            loose = middle;
            balance = there;
        } else {
            tight = middle;
        }
    }
    result.restRatio = loose;
    result.pull = cohesion * balance->pull;
    result.repulsion = std::max(material.repulsion, unit * balance->repulsion);
    return result;
}

double surfaceTension(const Material& material) {
    Material reduced = material;
    reduced.repulsion /= fifthPower(2.0 * material.radius);
    return kRelaxation * sumsOf(reduced).tension;
}

double capillaryLength(const Material& material, double gravity) {
    const double density = material.mass / cellVolume(2.0 * material.radius);
    return std::sqrt(material.cohesion / (density * gravity));
}

}  // namespace engine
