// The balls of a metaball field sorted by the cells of a grid in space, for rays that go in any direction: those that
// transparent bodies have refracted. Made by the preparation of a view that has such bodies.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/symmetric_matrix.h"
#include "render/prepare/skin/skin.h"

namespace render {

/// Balls sorted by cells, component by component. All balls whose kernels reach a point of a cell lie in the 27 cells
/// around it, in nine contiguous runs. Positions are relative to the eye, along the world's axes. Unused numbers follow
/// the last ball's, because whole vectors of them are read.
struct BallCells {
    glm::vec3 low{0.0F};               ///< corner of the first cell, below all kernels, m
    float side = 1.0F;                 ///< side of a cell, m: no kernel reaches farther than this
    glm::ivec3 count{0};               ///< number of cells along each axis; 0 without balls
    std::vector<std::uint32_t> begin;  ///< sorted index of each cell's first ball; at last the number of balls
    std::vector<float> x, y, z;        ///< centers, by sorted index, m
    std::vector<float> peak;           ///< of the kernels, as in BallKernel
    std::vector<float> squaredSlope;   ///< square of BallKernel's slope, 1/m^2
    /// Of an anisotropic skin the forms of the ellipsoids, entry by entry, in the order of SymmetricMatrix; empty else.
    std::array<std::vector<float>, 6> form;
    std::vector<std::int32_t> particle;  ///< index in the view of the particle that each ball stands for

    bool empty() const { return particle.empty(); }
    bool isAnisotropic() const { return !form[0].empty(); }
    SymmetricMatrix<float> formOf(std::size_t k) const {
        return {form[0][k], form[1][k], form[2][k], form[3][k], form[4][k], form[5][k]};
    }
    glm::vec3 high() const { return low + side * glm::vec3(count); }
};

/// Sorts the balls of all particles whose radius is above 0.
/// @param balls  one per particle, as skinOf() makes them
/// @param eye    world coordinates, m
BallCells ballCells(const View& view, std::span<const SkinBall> balls, glm::vec3 eye);

}  // namespace render
