// The face-centered cubic lattice, which stands for a liquid of the same density in compression.cpp and cohesion.cpp:
// both have nearly as many neighbors at nearly the same distances. The neighbors of a particle are in shells: c_n of
// them at a distance of sqrt(n) spacings, n = 1, 2, 3, ...
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace engine {

/// Shells of the lattice that are counted: up to this many squared spacings. Chosen: enough for the reach of any preset
/// at a lattice compressed to a twentieth of its rest length.
inline constexpr int kShellCount = 1600;

/// How many lattice points are at a distance of sqrt(n) spacings from one of them, for each n.
const std::array<double, kShellCount + 1>& shellSizes();

/// Volume per particle of a lattice with nearest neighbors at a spacing.
inline double cellVolume(double spacing) {
    return spacing * spacing * spacing / std::sqrt(2.0);
}

/// Sum over the neighbors of a particle that are nearer than a reach, shell by shell.
/// @param term  term(number of neighbors, squared distance) returns the sum over a shell
template <class Term>
double sumOverShells(double spacing, double reachSq, const Term& term) {
    double sum = 0.0;
    for (std::size_t n = 1; n <= kShellCount; ++n) {
        const double distanceSq = spacing * spacing * static_cast<double>(n);
        if (distanceSq >= reachSq) break;
        sum += term(shellSizes()[n], distanceSq);
    }
    return sum;
}

}  // namespace engine
