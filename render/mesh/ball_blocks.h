// The balls of a metaball field, listed for each block of a lattice that their kernels reach: the field at the
// lattice's nodes, block by block, and at any point. Blocks that no ball reaches take no memory. Used by the mesh of
// the surface.
//
// The lattice has its nodes at the integer multiples of the cell. A block has 8 nodes along each axis: block (i, j, k)
// those from (8 i, 8 j, 8 k) on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "render/prepare/skin/skin.h"

namespace render {

inline constexpr int kBlockSide = 8;
inline constexpr std::size_t kBlockNodes = 512;

/// One number for each node of a block; that of node (x, y, z) has the index (8 x + y) 8 + z.
using BlockNodes = std::array<float, kBlockNodes>;

struct BlockHash {
    std::size_t operator()(const glm::ivec3& block) const;
};

class BallBlocks {
 public:
    /// One ball of the field.
    struct Ball {
        glm::dvec3 center{0.0};
        BallKernel kernel;
        std::uint32_t particle = 0;                   ///< index of the particle that it stands for
        std::optional<SymmetricMatrix<double>> form;  ///< of an ellipsoid: its root is peak - d^T form d; 1/m^2

        /// The square root of the kernel where that is above zero. @param offset  from the center, m
        double root(const glm::dvec3& offset) const {
            return form ? double(kernel.peak) - dot(offset, form->times(offset)) : kernel.root(dot(offset, offset));
        }
        /// A factor times half of the gradient of what the root loses with the offset from the center, 1/m.
        glm::dvec3 steepness(double factor, const glm::dvec3& offset) const {
            const double slope = double(kernel.slope);
            return form ? factor * form->times(offset) : factor * slope * slope * offset;
        }
    };

    /// The balls of a view's particles whose radius is above 0. Balls more than 2^27 blocks away from the origin along
    /// an axis are left out.
    /// @param cell  distance of neighboring nodes, m, > 0
    BallBlocks(const View& view, double cell);

    double cell() const { return cell_; }
    /// The blocks that balls reach, sorted by x, y and z.
    std::span<const glm::ivec3> blocks() const { return blocks_; }

    /// The position in blocks() of a block; -1 if no ball reaches it.
    std::ptrdiff_t find(const glm::ivec3& block) const;

    /// The field at the nodes of a block, by its position in blocks(): summed in the order of the particles.
    void sample(std::size_t block, BlockNodes& field) const;

    /// Calls visit(ball, offset, root) for each ball whose kernel is above zero at a point, in the order of the
    /// particles: the ball, the vector from its center to the point (m), and the square root of its kernel.
    template <typename Visit>
    void forEachBallAt(const glm::dvec3& point, const Visit& visit) const {
        const std::ptrdiff_t block = find(blockOf(point));
        if (block < 0) return;
        for (const std::uint32_t index : ballsOf(static_cast<std::size_t>(block))) {
            const Ball& ball = balls_[index];
            const glm::dvec3 offset = point - ball.center;
            const double root = ball.root(offset);
            if (root > 0.0) visit(ball, offset, root);
        }
    }

 private:
    void listBalls(std::span<const glm::dvec3> extents);
    glm::ivec3 blockOf(const glm::dvec3& point) const;
    std::span<const std::uint32_t> ballsOf(std::size_t block) const {
        return std::span(items_).subspan(begin_[block], begin_[block + 1] - begin_[block]);
    }

    double cell_;
    std::vector<Ball> balls_;
    std::vector<glm::ivec3> blocks_;
    std::unordered_map<glm::ivec3, std::uint32_t, BlockHash> positions_;  ///< position of each block in blocks_
    std::vector<std::size_t> begin_;  ///< index in items_ of the first ball of each block; at last the number of items
    std::vector<std::uint32_t> items_;  ///< indices of the balls of each block, block by block, increasing
};

}  // namespace render
