// The constants of the force law for every pair of materials, from which the kernels over pairs read. Kept by
// PairTraversal for particles of several materials with different laws.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "engine/force_law/material.h"
#include "engine/force_law/pair_law.h"

namespace engine {

/// What SIMD kernels read for a pair of materials, in their precision, in blocks of four numbers: first those by which
/// most materials differ, then those that many have in common.
template <class T>
struct alignas(8 * sizeof(T)) PairTableRow {
    T b1;
    T bd;
    T inverseReachSq;
    T friction;
    T reach;      ///< R, for energies
    T halfSlope;  ///< half the coefficient of P inside the core distance, N/m; for energies
    T coreSq;
    T inverseDampingSq;
};

/// What SIMD kernels with cohesion read besides; the rest length is another for each pair of materials there.
template <class T>
struct alignas(4 * sizeof(T)) PullTableRow {
    T pull;
    T pullReachSq;
    T inversePullWidth;
    T inverseRestSq;
};

/// Whether damping has a reach of its own in kernels with these terms.
constexpr bool hasDampingReach(PairTerms terms) {
    return terms.damping && !terms.equalReach;
}

/// The constants in T. They are rounded in such a way that for every distance D at or beyond a rounded reach the
/// rounded 1/D^2 does not exceed the inverse square of that reach.
template <class T>
PairConstants<T> roundedConstants(const PairConstants<double>& exact) {
    if constexpr (std::is_same_v<T, double>) return exact;
    const auto roundedDown = [](double number) {
        const T rounded = static_cast<T>(number);
        return static_cast<double>(rounded) > number ? std::nextafter(rounded, T(0)) : rounded;
    };
    const auto roundedInverse = [](double inverseSq) { return T(1) / static_cast<T>(1.0 / inverseSq); };
    return {.b1 = static_cast<T>(exact.b1),
            .bd = static_cast<T>(exact.bd),
            .inverseRestSq = roundedInverse(exact.inverseRestSq),
            .inverseReachSq = roundedInverse(exact.inverseReachSq),
            .reachSq = static_cast<T>(exact.reachSq),
            .inverseDampingSq = roundedInverse(exact.inverseDampingSq),
            .coreSq = static_cast<T>(exact.coreSq),
            .friction = static_cast<T>(exact.friction),
            .cutoffSq = static_cast<T>(exact.cutoffSq),
            .pull = static_cast<T>(exact.pull),
            .pullReachSq = roundedDown(exact.pullReachSq),
            .inversePullWidth = static_cast<T>(exact.inversePullWidth)};
}

/// Constants of the pairs of a material at a rest length (m). A rest length of 0 stands for several: the result is then
/// constantsPerRestLength().
template <class T>
PairConstants<T> constantsAt(const Material& material, double restLength) {
    if (restLength > 0.0) return roundedConstants<T>(pairConstants<double>(material, restLength));
    return constantsPerRestLength<T>(material);
}

/// The table in the precision of the SIMD kernels.
template <class T>
struct PairTableIn {
    std::vector<PairTableRow<T>> rows;
    std::vector<PullTableRow<T>> pullRows;
    T inverseRestSq = T(0);  ///< 1/D0^2 of every pair, where all have one rest length
    /// The first rows by columns, as many as a SIMD register holds: the fields of `rows`, then those of `pullRows`.
    std::array<std::array<T, 64 / sizeof(T)>, 12> columns = {};
    bool rangesDiffer = false;  ///< whether pairs of materials differ in core distance or reach of the damping
};

/// The table, with an entry for every material and every other; symmetric bit for bit. It is empty for more than
/// kMostTabulated materials.
struct PairTable {
    std::vector<Material> mixtures;  ///< see tabulatedMixtures()
    std::size_t materialCount = 0;
    bool oneLaw = true;        ///< whether all materials have the same law; the table then has a single entry
    double restLength = -1.0;  ///< rest length that the entries were computed for, as in constantsAt()
    std::vector<PairConstants<double>> constants;
    PairTableIn<double> doubles;
    PairTableIn<float> singles;

    PairTable() = default;
    explicit PairTable(const std::vector<Material>& materials);

    /// Computes the entries unless it has done so before.
    /// @param wanted  rest length of every pair as in constantsAt()
    void fill(double wanted);

    template <class T>
    const PairTableIn<T>& in() const {
        if constexpr (std::is_same_v<T, double>)
            return doubles;
        else
            return singles;
    }

    /// The entry of two materials; null where there is no table.
    const PairConstants<double>* entryOf(std::uint32_t p, std::uint32_t i) const {
        if (oneLaw) return &constants.front();
        return mixtures.empty() ? nullptr : &constants[p * materialCount + i];
    }

    /// The same, computed anew where there is no table.
    PairConstants<double> constantsOf(const std::vector<Material>& materials, std::uint32_t p, std::uint32_t i) const;
};

}  // namespace engine
