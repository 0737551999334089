// Where the field of metaballs is surely above its threshold, surely below, or may cross it, cell by cell, so that rays
// evaluate it near the surface only. Made by the preparation of a view that has transparent bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/prepare/rays/ball_cells.h"

namespace render {

/// A block or a subcell in which the field is nowhere above the threshold, or nowhere below it.
inline constexpr std::int32_t kAllOutside = -1;
inline constexpr std::int32_t kAllInside = -2;

/// A part of a block. If the field may cross the threshold in it, the balls whose kernels reach it are listed.
struct Subcell {
    std::uint32_t first = 0;           ///< of its balls in FieldCells::balls
    std::int32_t count = kAllOutside;  ///< number of its balls, kAllInside or kAllOutside
};

/// All blocks, which are the cells of BallCells, and the subcells of those that the surface may pass through.
struct FieldCells {
    std::uint64_t id = 0;  ///< another one for each field in the program, above 0; copies have the same
    int along = 4;         ///< number of subcells along each side of a block, a power of two
    /// Of each block: kAllInside, kAllOutside, or its number among those with subcells.
    std::vector<std::int32_t> blocks;
    std::vector<Subcell> subcells;  ///< subcellsOfBlock() for each block, x fastest
    std::vector<std::uint32_t> balls;  ///< indices in BallCells, ascending within a subcell

    bool empty() const { return blocks.empty(); }
    std::size_t subcellsOfBlock() const { return static_cast<std::size_t>(along * along * along); }
};

/// Classifies the cells of a field. The result is the same bits on every instruction set and by any number of threads.
/// @param threshold  value of the field at the surface, above 0
FieldCells fieldCells(const BallCells& cells, float threshold);

}  // namespace render
