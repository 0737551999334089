// Compiled once per instruction set: as many positions at a time as a vector has lanes. Numbers of cells that are used
// are whole and exact in double.
#include "engine/neighbors/cell_axes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/neighbors/cell_axes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<double> kTag{};
constexpr hn::RebindToUnsigned<decltype(kTag)> kBits{};
constexpr hn::Rebind<std::uint32_t, decltype(kTag)> kCells{};
using V = hn::Vec<decltype(kTag)>;
using M = hn::Mask<decltype(kTag)>;

/// CellAxis over lanes.
class Axis {
 public:
    explicit Axis(const CellAxis& axis)
        : width_(hn::Set(kTag, axis.width)),
          size_(hn::Set(kTag, static_cast<double>(axis.size))),
          first_(hn::Set(kTag, static_cast<double>(axis.first))),
          stored_(hn::Set(kTag, static_cast<double>(axis.stored))) {}

    /// Cells from the first one on.
    V stepsTo(V coordinate) const { return hn::Sub(hn::Floor(hn::Div(coordinate, width_)), first_); }

    /// False for what is no number.
    M areUsed(V steps) const { return hn::And(hn::Ge(steps, hn::Zero(kTag)), hn::Lt(steps, size_)); }

    V cellAfter(V steps) const {
        const V cell = hn::Add(stored_, steps);
        return hn::IfThenElse(hn::Lt(cell, size_), cell, hn::Sub(cell, size_));
    }

    V size() const { return size_; }

 private:
    V width_, size_, first_, stored_;
};

void findCellsHere(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells) {
    const Axis alongX(axes[0]), alongY(axes[1]), alongZ(axes[2]);
    const std::size_t lanes = hn::Lanes(kTag);
    const V whole = hn::Set(kTag, 0x1p52);  // a sum with it ends in the 32 bits of a whole number
    std::size_t p = 0;
    for (; p + lanes <= count; p += lanes) {
        V x, y, z;
        hn::LoadInterleaved3(kTag, positions[p].data(), x, y, z);
        x = alongX.stepsTo(x);
        y = alongY.stepsTo(y);
        z = alongZ.stepsTo(z);
        if (!hn::AllTrue(kTag, hn::And(alongX.areUsed(x), hn::And(alongY.areUsed(y), alongZ.areUsed(z))))) {
            for (std::size_t of = p; of < p + lanes; ++of) cells[of] = cellAt(axes, positions[of]);
            continue;
        }
        const V row = hn::Add(hn::Mul(alongZ.cellAfter(z), alongY.size()), alongY.cellAfter(y));
        const V cell = hn::Add(hn::Mul(row, alongX.size()), alongX.cellAfter(x));
        hn::StoreU(hn::TruncateTo(kCells, hn::BitCast(kBits, hn::Add(cell, whole))), kCells, cells + p);
    }
    for (; p < count; ++p) cells[p] = cellAt(axes, positions[p]);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(findCellsHere);

void findCells(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells) {
    HWY_DYNAMIC_DISPATCH(findCellsHere)(axes, positions, count, cells);
}

}  // namespace engine

#endif
