// The pressure of a lattice and the height of a column under its own weight.
//
// Pressure. By the virial theorem, particles at rest with pair forces F(D) along the line between them, positive where
// they repel, have the pressure p = 1/(6 V) sum_j D_j F(D_j), where V is the volume per particle and the sum runs over
// all neighbors j of one particle. In a face-centered cubic lattice whose nearest neighbors are a apart, V = a^3 /
// sqrt(2), and the neighbors are in shells: c_n of them at the distance a sqrt(n), n = 1, 2, 3, ... The lattice stands
// for a liquid of the same density, which has nearly as many neighbors at nearly the same distances.
//
// Height. At rest the pressure at a depth carries the weight of what lies above. A column of height H0 with the volume
// V0 per particle before it sinks has P = m g H0 / V0 at its floor. The weight above, p, is proportional to the number
// of particles above, so that each part dp of it takes up a height proportional to V(p), and the share of the height
// that is left is
//     H / H0 = 1/P integral from 0 to P of V(p)/V0 dp.
// The integral is taken over the table of p(a) itself, from the spacing without pressure down to the one where p = P.
//
// All of it is computed in units of the rest length D0 and of b1: the force is b1/D0^4 times a function of D/D0, hence
// p is b1/D0^6 times a function of a/D0. A material whose b1 grows with the sixth power of its radius therefore has the
// same stiffness at any radius.
#include "engine/force_law/compression.h"

#include <algorithm>
#include <cmath>

#include "engine/force_law/cohesion.h"
#include "engine/force_law/lattice.h"
#include "engine/force_law/pair_law.h"

namespace engine {
namespace {

/// Factor between two spacings in the table. Chosen: the trapezoids of the integral err by less than 1e-4.
constexpr double kSpacingFactor = 0.995;

/// Least spacing in the table, in rest lengths. Chosen: a lattice that is compressed further takes up no room.
constexpr double kLeastSpacing = 0.05;

/// How often an interval is halved in which a solution lies. Chosen: until it is no wider than rounding.
constexpr int kHalvings = 100;

/// The same for a material with cohesion, for each half of which a column is computed anew. Chosen: b1 is then right to
/// a millionth.
constexpr int kCohesiveHalvings = 26;

double cube(double number) {
    return number * number * number;
}

/// The material's pair law with b1 = 1 and D0 = 1.
PairConstants<double> reducedLaw(Material material) {
    const double rest = 2.0 * material.radius;
    if (material.pull > 0.0) material.pull *= cube(rest) * rest * rest / material.repulsion;
    material.repulsion = 1.0;
    return pairConstants<double>(material, 1.0);
}

/// Pressure of a lattice in units of b1/D0^6.
/// @param spacing  in rest lengths
double reducedPressure(const PairConstants<double>& law, double spacing) {
    const double reachSq = law.pull > 0.0 ? std::max(law.reachSq, law.pullReachSq) : law.reachSq;
    const double sum = sumOverShells(spacing, reachSq, [&](double count, double distanceSq) {
        return count * distanceSq * pairCoefficient<kConservative>(distanceSq, 0.0, law);
    });
    return sum / (6.0 * cellVolume(spacing));
}

/// The largest spacing without pressure, in rest lengths.
double reducedRestSpacing(const PairConstants<double>& law) {
    double loose = std::sqrt(law.reachSq);
    double tight = loose;
    while (reducedPressure(law, tight) <= 0.0 && tight > kLeastSpacing) {
        loose = tight;
        tight *= kSpacingFactor;
    }
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (loose + tight);
        (reducedPressure(law, middle) > 0.0 ? tight : loose) = middle;
    }
    return loose;
}

/// Mean volume per particle of a column at rest, in D0^3.
/// @param floorPressure  in units of b1/D0^6
double meanVolume(const PairConstants<double>& law, double floorPressure) {
    double spacing = reducedRestSpacing(law);
    double pressure = 0.0;
    double volume = cellVolume(spacing);
    double integral = 0.0;
    while (pressure < floorPressure && spacing > kLeastSpacing) {
        spacing *= kSpacingFactor;
        const double nextVolume = cellVolume(spacing);
        const double nextPressure = reducedPressure(law, spacing);
        // Where the pressure falls with the spacing, the lattice gives way without taking on weight.
        if (nextPressure > pressure) {
            const double part = std::min(1.0, (floorPressure - pressure) / (nextPressure - pressure));
            integral += part * (nextPressure - pressure) * (volume + 0.5 * part * (nextVolume - volume));
            pressure = nextPressure;
        }
        volume = nextVolume;
    }
    if (pressure < floorPressure) integral += (floorPressure - pressure) * volume;
    return integral / floorPressure;
}

/// Pressure at the floor of a column, in pascals.
double floorPressureOf(const Material& material, const Column& column) {
    return material.mass * column.gravity * column.height / cellVolume(column.spacing);
}

/// repulsionForShare() of a material with cohesion, whose rest ratio follows from b1.
std::optional<double> cohesiveRepulsionForShare(Material material, const Column& column, double share) {
    const double unit = material.cohesion * std::pow(2.0 * material.radius, 5);
    const auto shareWith = [&](double repulsion) {
        material.repulsion = repulsion;
        return settledShare(withCohesion(material, material.cohesion).value_or(material), column);
    };
    double low = 1e-3 * unit;
    double high = 1e9 * unit;
    if (shareWith(high) < share) return std::nullopt;
    for (int k = 0; k < kCohesiveHalvings; ++k) {
        const double middle = std::sqrt(low * high);
        (shareWith(middle) < share ? low : high) = middle;
    }
    return high;
}

}  // namespace

double latticePressure(const Material& material, double spacing) {
    const double rest = 2.0 * material.radius;
    return material.repulsion / (cube(rest) * cube(rest)) * reducedPressure(reducedLaw(material), spacing / rest);
}

double restSpacing(const Material& material) {
    return 2.0 * material.radius * reducedRestSpacing(reducedLaw(material));
}

bool drawsTogether(const Material& material, const Column& column) {
    constexpr double kAlike = 0.999;  // a ratio of lengths that are the same but for rounding; chosen
    const double rest = restSpacing(material);
    const bool pullsFar = material.pull > 0.0 || rest < kAlike * 2.0 * material.radius;
    return pullsFar && rest < kAlike * column.spacing;
}

double settledShare(const Material& material, const Column& column) {
    const double rest = 2.0 * material.radius;
    const double volumeBefore = cellVolume(column.spacing / rest);
    const PairConstants<double> law = reducedLaw(material);
    const double floorPressure = floorPressureOf(material, column) * cube(rest) * cube(rest);
    if (floorPressure == 0.0) return cellVolume(reducedRestSpacing(law)) / volumeBefore;
    if (material.repulsion == 0.0) return 0.0;
    return meanVolume(law, floorPressure / material.repulsion) / volumeBefore;
}

std::optional<double> repulsionForShare(const Material& material, const Column& column, double share) {
    if (material.cohesion > 0.0) return cohesiveRepulsionForShare(material, column, share);
    const double rest = 2.0 * material.radius;
    const PairConstants<double> law = reducedLaw(material);
    const double wanted = share * cellVolume(column.spacing / rest);
    if (wanted >= cellVolume(reducedRestSpacing(law))) return std::nullopt;
    // The mean volume falls with the pressure at the floor, in units of b1/D0^6. The interval is halved on a
    // logarithmic scale.
    double low = 1e-12;
    double high = 1e12;
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = std::sqrt(low * high);
        (meanVolume(law, middle) > wanted ? low : high) = middle;
    }
    return floorPressureOf(material, column) * cube(rest) * cube(rest) / low;
}

}  // namespace engine
