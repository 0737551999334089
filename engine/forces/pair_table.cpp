// Tabulates the constants of the force law for every pair of materials.
#include "engine/forces/pair_table.h"

#include <algorithm>
#include <cmath>

#include "engine/forces/force_field.h"

namespace engine {
namespace {

template <class T>
PairTableRow<T> rowOf(const Material& material, double restLength, bool hasDampingReach) {
    const PairConstants<T> c = constantsAt<T>(material, restLength);
    return {.b1 = c.b1,
            .bd = c.bd,
            .coreSq = c.coreSq,
            .outerInverseSq = hasDampingReach ? c.inverseDampingSq : c.inverseReachSq,
            .inverseReachSq = c.inverseReachSq,
            .friction = c.friction,
            .reach = std::sqrt(c.reachSq),
            .halfSlope = T(0.5) * pairCoefficient<kConservative>(c.coreSq, T(0), c)};
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
PairTableIn<T> tableOf(const std::vector<Material>& mixtures, double restLength, bool hasDampingReach) {
    PairTableIn<T> table;
    table.inverseRestSq = constantsAt<T>(mixtures.front(), restLength).inverseRestSq;
    for (const Material& material : mixtures) {
        table.rows.push_back(rowOf<T>(material, restLength, hasDampingReach));
        table.pullRows.push_back(pullRowOf<T>(material, restLength));
    }
    for (std::size_t k = 0; k < std::min(table.rows.size(), table.columns[0].size()); ++k) {
        const PairTableRow<T>& row = table.rows[k];
        const std::array<T, 8> fields = {row.b1,       row.bd,    row.coreSq,   row.outerInverseSq, row.inverseReachSq,
                                         row.friction, row.reach, row.halfSlope};
        for (std::size_t field = 0; field < fields.size(); ++field) table.columns[field][k] = fields[field];
        const PullTableRow<T>& pull = table.pullRows[k];
        const std::array<T, 4> pullFields = {pull.pull, pull.pullReachSq, pull.inversePullWidth, pull.inverseRestSq};
        for (std::size_t field = 0; field < pullFields.size(); ++field) table.pullColumns[field][k] = pullFields[field];
    }
    return table;
}

}  // namespace

PairTable::PairTable(const std::vector<Material>& materials) {
    if (materials.empty()) return;
    oneLaw = isOneLaw(materials);
    mixtures = oneLaw ? std::vector{materials.front()} : tabulatedMixtures(materials);
    materialCount = materials.size();
}

void PairTable::fill(PairTerms needed, double wanted) {
    if (wanted == restLength) return;
    restLength = wanted;
    constants.clear();
    const bool isDamping = withTerms(needed, []<PairTerms terms>() { return hasDampingReach(terms); });
    for (const Material& material : mixtures) constants.push_back(constantsAt<double>(material, restLength));
    if (mixtures.empty()) return;
    doubles = tableOf<double>(mixtures, restLength, isDamping);
    singles = tableOf<float>(mixtures, restLength, isDamping);
}

PairConstants<double> PairTable::constantsOf(const std::vector<Material>& materials, std::uint32_t p,
                                             std::uint32_t i) const {
    if (oneLaw) return constants.front();
    if (!mixtures.empty()) return constants[p * materialCount + i];
    return constantsAt<double>(tabulated(materials[p], materials[i]), restLength);
}

}  // namespace engine
