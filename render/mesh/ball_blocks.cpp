// The blocks of each ball are visited twice: to count the balls of each block, and to list them.
#include "render/mesh/ball_blocks.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace render {
namespace {

/// Farthest block along an axis: the coordinates of its nodes are still integers of 32 bits.
constexpr double kFarthest = 134217728.0;  // 2^27

struct BlockRange {
    glm::ivec3 low{0}, high{0};  ///< first and last block along each axis
};

/// The blocks that a ball's kernel reaches. @param reach  along each axis, m
/// @param side  of a block, m
BlockRange rangeOf(const glm::dvec3& center, const glm::dvec3& reach, double side) {
    return {glm::ivec3(floor((center - reach) / side)), glm::ivec3(floor((center + reach) / side))};
}

/// Whether a ball lies where blocks have numbers; false for a center that is not finite.
bool isNear(const glm::dvec3& center, const glm::dvec3& reach, double side) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(center[axis]) + reach[axis] < kFarthest * side)) return false;
    return true;
}

/// The form of a ball of an anisotropic skin.
SymmetricMatrix<double> formOf(const SkinBall& ball) {
    const SymmetricMatrix<float>& s = ball.spread;
    return inverse(SymmetricMatrix<double>{double(s.xx), double(s.yy), double(s.zz), double(s.xy), double(s.xz),
                                           double(s.yz)}) *
           double(kernelOf(ball).peak);
}

/// Adds the kernel of an ellipsoid to the nodes of a block.
/// @param first  the vector from its center to the block's first node, m
/// @param step   distance of neighboring nodes, m
void addEllipsoid(const BallBlocks::Ball& ball, const glm::dvec3& first, double step, BlockNodes& field) {
    for (int x = 0; x < kBlockSide; ++x) {
        for (int y = 0; y < kBlockSide; ++y) {
            float* const row = &field[static_cast<std::size_t>((x * kBlockSide + y) * kBlockSide)];
            for (int z = 0; z < kBlockSide; ++z) {
                const auto root = static_cast<float>(std::max(0.0, ball.root(first + step * glm::dvec3(x, y, z))));
                row[z] += root * root;
            }
        }
    }
}

template <typename Visit>
void forEachBlock(const BlockRange& range, const Visit& visit) {
    for (int x = range.low.x; x <= range.high.x; ++x)
        for (int y = range.low.y; y <= range.high.y; ++y)
            for (int z = range.low.z; z <= range.high.z; ++z) visit(glm::ivec3(x, y, z));
}

}  // namespace

std::size_t BlockHash::operator()(const glm::ivec3& block) const {
    // FNV-1a over the three coordinates, with a shift that mixes high bits into the low ones.
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (int axis = 0; axis < 3; ++axis) {
        hash = (hash ^ static_cast<std::uint32_t>(block[axis])) * 0x100000001b3U;
        hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
}

BallBlocks::BallBlocks(const View& view, double cell) : cell_(cell) {
    const std::vector<SkinBall> skin = skinOf(view);
    const double side = kBlockSide * cell;
    std::vector<glm::dvec3> extents;
    for (std::size_t k = 0; k < skin.size(); ++k) {
        const SkinBall& ball = skin[k];
        const glm::dvec3 extent(extentAlong(view, ball, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}));
        if (!(view.particles[k].radius > 0.0F) || !isNear(ball.center, extent, side)) continue;
        balls_.push_back({glm::dvec3(ball.center), kernelOf(ball), static_cast<std::uint32_t>(k), {}});
        if (view.field.skin == Skin::anisotropic) balls_.back().form = formOf(ball);
        extents.push_back(extent);
    }
    listBalls(extents);
}

void BallBlocks::listBalls(std::span<const glm::dvec3> extents) {
    const double side = kBlockSide * cell_;
    const auto visitAll = [&](const auto& visit) {
        for (std::size_t k = 0; k < extents.size(); ++k)
            forEachBlock(rangeOf(balls_[k].center, extents[k], side),
                         [&](const glm::ivec3& block) { visit(block, static_cast<std::uint32_t>(k)); });
    };
    visitAll([&](const glm::ivec3& block, std::uint32_t) { ++positions_[block]; });
    for (const auto& [block, count] : positions_) blocks_.push_back(block);
    std::sort(blocks_.begin(), blocks_.end(), [](const glm::ivec3& a, const glm::ivec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    begin_.assign(1, 0);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
        std::uint32_t& entry = positions_[blocks_[k]];
        begin_.push_back(begin_.back() + entry);
        entry = static_cast<std::uint32_t>(k);
    }
    items_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    visitAll([&](const glm::ivec3& block, std::uint32_t ball) { items_[next[positions_[block]]++] = ball; });
}

glm::ivec3 BallBlocks::blockOf(const glm::dvec3& point) const {
    return glm::ivec3(floor(point / (kBlockSide * cell_)));
}

std::ptrdiff_t BallBlocks::find(const glm::ivec3& block) const {
    const auto found = positions_.find(block);
    return found == positions_.end() ? -1 : static_cast<std::ptrdiff_t>(found->second);
}

void BallBlocks::sample(std::size_t block, BlockNodes& field) const {
    field.fill(0.0F);
    const glm::dvec3 first = double(kBlockSide) * cell_ * glm::dvec3(blocks_[block]);
    const auto step = static_cast<float>(cell_);
    for (const std::uint32_t index : ballsOf(block)) {
        const Ball& ball = balls_[index];
        if (ball.form) {
            addEllipsoid(ball, first - ball.center, cell_, field);
            continue;
        }
        const glm::vec3 offset(first - ball.center);
        std::array<float, kBlockSide> squaredZ;
        for (int z = 0; z < kBlockSide; ++z) {
            const float away = offset.z + static_cast<float>(z) * step;
            squaredZ[static_cast<std::size_t>(z)] = away * away;
        }
        for (int x = 0; x < kBlockSide; ++x) {
            const float awayX = offset.x + static_cast<float>(x) * step;
            for (int y = 0; y < kBlockSide; ++y) {
                const float awayY = offset.y + static_cast<float>(y) * step;
                const float squared = awayX * awayX + awayY * awayY;
                if (!(ball.kernel.root(squared) > 0.0F)) continue;
                float* const row = &field[static_cast<std::size_t>((x * kBlockSide + y) * kBlockSide)];
                for (std::size_t z = 0; z < kBlockSide; ++z) {
                    const float root = std::max(0.0F, ball.kernel.root(squared + squaredZ[z]));
                    row[z] += root * root;
                }
            }
        }
    }
}

}  // namespace render
