// Some balls of a metaball field, copied so that vectors of them lie side by side. Used where the field is evaluated at
// many points near each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/prepare/rays/ball_cells.h"

namespace render {

/// What is known of each ball of a set, which are its columns. Round balls have a center, a peak and a squared slope,
/// ellipsoids have the entries of their form in place of the slope, in the order of SymmetricMatrix.
enum BallValue : std::size_t { kBallX, kBallY, kBallZ, kBallPeak, kBallForm, kBallValues = kBallForm + 6 };

/// Balls, column by column. Sums over them run over whole blocks, as simd_sums-inl.h says, of which the last is filled
/// up with balls of no kernel.
class BallSet {
 public:
    static constexpr std::size_t kSetBlock = 16;

    std::size_t size() const { return index_.size(); }
    const float* column(std::size_t value) const { return values_.data() + value * stride_; }
    /// Index in BallCells of a ball of the set.
    std::int32_t index(std::size_t k) const { return index_[k]; }

    /// Takes `count` balls of the cells. @param indexOf  the index of the k-th of them, in BallCells
    template <typename IndexOf>
    void assign(const BallCells& cells, std::size_t count, const IndexOf& indexOf) {
        const std::size_t whole = (count + kSetBlock - 1) / kSetBlock * kSetBlock;
        if (stride_ < whole) {
            stride_ = 2 * whole;
            values_.resize(kBallValues * stride_);
        }
        index_.resize(count);
        for (std::size_t k = 0; k < count; ++k) index_[k] = static_cast<std::int32_t>(indexOf(k));
        copy(cells.x, kBallX, whole);
        copy(cells.y, kBallY, whole);
        copy(cells.z, kBallZ, whole);
        copy(cells.peak, kBallPeak, whole);
        std::fill_n(values_.data() + kBallPeak * stride_ + count, whole - count, -1.0F);
        if (!cells.isAnisotropic()) return copy(cells.squaredSlope, kBallForm, whole);
        for (std::size_t k = 0; k < cells.form.size(); ++k) copy(cells.form[k], kBallForm + k, whole);
    }

    /// Takes all balls that lie in a cell or in one of those around it: all that reach a point of it.
    void assignAround(const BallCells& cells, glm::ivec3 cell);

 private:
    /// Fills in a column, up to a whole number of blocks with 0.
    void copy(const std::vector<float>& from, std::size_t column, std::size_t whole) {
        float* const to = values_.data() + column * stride_;
        for (std::size_t k = 0; k < index_.size(); ++k) to[k] = from[static_cast<std::size_t>(index_[k])];
        std::fill(to + index_.size(), to + whole, 0.0F);
    }

    std::size_t stride_ = 0;  // between columns
    std::vector<float> values_;
    std::vector<std::int32_t> index_;
};

}  // namespace render
