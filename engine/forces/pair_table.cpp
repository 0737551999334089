// Tabulates the constants of the force law for every pair of materials.
#include "engine/forces/pair_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/forces/force_field.h"

namespace engine {
namespace {

template <class T>
PairTableRow<T> rowOf(const Material& material, double restLength) {
    const PairConstants<T> c = constantsAt<T>(material, restLength);
    return {.b1 = c.b1,
            .bd = c.bd,
            .inverseReachSq = c.inverseReachSq,
            .friction = c.friction,
            .reach = std::sqrt(c.reachSq),
            .halfSlope = T(0.5) * pairCoefficient<kConservative>(c.coreSq, T(0), c),
            .coreSq = c.coreSq,
            .inverseDampingSq = c.inverseDampingSq};
}

template <class T>
PullTableRow<T> pullRowOf(const Material& material, double restLength) {
    const PairConstants<T> c = constantsAt<T>(material, restLength);
    return {.pull = c.pull,
            .pullReachSq = c.pullReachSq,
            .inversePullWidth = c.inversePullWidth,
            .inverseRestSq = c.inverseRestSq};
}

template <class T>
PairTableIn<T> tableOf(const std::vector<Material>& mixtures, double restLength) {
    PairTableIn<T> table;
    table.inverseRestSq = constantsAt<T>(mixtures.front(), restLength).inverseRestSq;
    for (const Material& material : mixtures) {
        table.rows.push_back(rowOf<T>(material, restLength));
        table.pullRows.push_back(pullRowOf<T>(material, restLength));
    }
    for (std::size_t k = 0; k < std::min(table.rows.size(), table.columns[0].size()); ++k) {
        const auto fields = std::bit_cast<std::array<T, 8>>(table.rows[k]);
        const auto pullFields = std::bit_cast<std::array<T, 4>>(table.pullRows[k]);
        for (std::size_t field = 0; field < fields.size(); ++field) table.columns[field][k] = fields[field];
        for (std::size_t field = 0; field < pullFields.size(); ++field)
            table.columns[fields.size() + field][k] = pullFields[field];
    }
    const PairTableRow<T>& first = table.rows.front();
    table.rangesDiffer = std::ranges::any_of(table.rows, [&](const PairTableRow<T>& row) {
        return row.coreSq != first.coreSq || row.inverseDampingSq != first.inverseDampingSq;
    });
    return table;
}

}  // namespace

PairTable::PairTable(const std::vector<Material>& materials) {
    if (materials.empty()) return;
    oneLaw = isOneLaw(materials);
    mixtures = oneLaw ? std::vector{materials.front()} : tabulatedMixtures(materials);
    materialCount = materials.size();
}

void PairTable::fill(double wanted) {
    if (wanted == restLength) return;
    restLength = wanted;
    constants.clear();
    for (const Material& material : mixtures) constants.push_back(constantsAt<double>(material, restLength));
    if (mixtures.empty()) return;
    doubles = tableOf<double>(mixtures, restLength);
    singles = tableOf<float>(mixtures, restLength);
}

PairConstants<double> PairTable::constantsOf(const std::vector<Material>& materials, std::uint32_t p,
                                             std::uint32_t i) const {
    if (const PairConstants<double>* entry = entryOf(p, i)) return *entry;
    return constantsAt<double>(tabulated(materials[p], materials[i]), restLength);
}

}  // namespace engine
