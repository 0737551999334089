// Tabulates the constants of the force law for every pair of materials.
#include "engine/forces/pair_table.h"

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
    doubles.clear();
    singles.clear();
    const bool isDamping = withTerms(needed, []<PairTerms terms>() { return hasDampingReach(terms); });
    for (const Material& material : mixtures) {
        constants.push_back(constantsAt<double>(material, restLength));
        doubles.push_back(rowOf<double>(material, restLength, isDamping));
        singles.push_back(rowOf<float>(material, restLength, isDamping));
    }
}

PairConstants<double> PairTable::constantsOf(const std::vector<Material>& materials, std::uint32_t p,
                                             std::uint32_t i) const {
    if (oneLaw) return constants.front();
    if (!mixtures.empty()) return constants[p * materialCount + i];
    return constantsAt<double>(tabulated(materials[p], materials[i]), restLength);
}

}  // namespace engine
