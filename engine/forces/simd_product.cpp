// The kernel, compiled once per instruction set.
#include "engine/forces/pair_matrix.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_product.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// Flattened, as the forces' kernel is.
template <bool hasFriction, class Entry>
HWY_FLATTEN void multiplyBlock(const PairMatrix& matrix, std::size_t group, std::size_t lane, LaneProduct& product) {
    constexpr Tag<double> kTag{};
    const std::size_t first = group * kGroup + lane;
    const std::size_t part = LaneRows::partOf(first);
    const RowPart& rows = matrix.rows.parts[part];
    const Doubles source(matrix.records.data(), &matrix.rows.selves[first], rows.base);
    const std::uint32_t longest = longestRow<double>(matrix.rows, first);
    Vector3<Lanes<double>> sum{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    std::size_t entry = matrix.rows.at(first, 0);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kGroup) {
        const Entry* places = &entriesOf<Entry>(rows)[entry];
        fetchAhead(places);
        fetchAhead(&matrix.along[part][entry]);
        const Row<double> row = source.row<true>(places, source.load<true>(places));
        const auto along = hn::LoadU(kTag, &matrix.along[part][entry]);
        const auto push = hn::Mul(along, dot(row.velocity, row.separation));
        sum.x = hn::Add(sum.x, hn::Mul(push, row.separation.x));
        sum.y = hn::Add(sum.y, hn::Mul(push, row.separation.y));
        sum.z = hn::Add(sum.z, hn::Mul(push, row.separation.z));
        if constexpr (hasFriction) {
            const auto across = hn::LoadU(kTag, &matrix.across[part][entry]);
            sum.x = hn::Add(sum.x, hn::Mul(across, row.velocity.x));
            sum.y = hn::Add(sum.y, hn::Mul(across, row.velocity.y));
            sum.z = hn::Add(sum.z, hn::Mul(across, row.velocity.z));
        }
    }
    hn::StoreU(sum.x, kTag, &product.x[lane]);
    hn::StoreU(sum.y, kTag, &product.y[lane]);
    hn::StoreU(sum.z, kTag, &product.z[lane]);
}

template <class Entry>
void multiplyLanes(const PairMatrix& matrix, std::size_t group, LaneProduct& product) {
    const bool hasFriction = !matrix.across.empty();
    for (std::size_t lane = 0; lane < kGroup; lane += hn::Lanes(Tag<double>()))
        hasFriction ? multiplyBlock<true, Entry>(matrix, group, lane, product)
                    : multiplyBlock<false, Entry>(matrix, group, lane, product);
}

void multiplyGroupHere(const PairMatrix& matrix, std::size_t group, LaneProduct& product) {
    matrix.rows.parts[LaneRows::partOf(group * kGroup)].isWide() ? multiplyLanes<std::int32_t>(matrix, group, product)
                                                                 : multiplyLanes<std::uint16_t>(matrix, group, product);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(multiplyGroupHere);

void multiplyGroup(const PairMatrix& matrix, std::size_t group, LaneProduct& product) {
    HWY_DYNAMIC_DISPATCH(multiplyGroupHere)(matrix, group, product);
}

}  // namespace engine

#endif
