// The lattices of particles that the benchmark measures on: of one material, of two and of sixteen with different force
// laws, of two materials that melt, and of particles of unequal radii.
#pragma once

#include <span>
#include <string>

#include "engine/state/setup.h"

namespace studies {

/// What the particles of a lattice differ in.
enum class Differences { none, twoLaws, sixteenLaws, heat, radii };

/// A lattice of particles.
struct Packing {
    const char* name;
    const char* material;
    double spacing = 1.0;  ///< distance of nearest neighbors, in rest lengths of the material
    Differences differences = Differences::none;
};

/// All lattices. Those whose particles differ follow the lattice of the same material whose particles are alike.
std::span<const Packing> packings();

/// So many particles of a lattice, in a cube without gravity or obstacles.
engine::Setup packedCube(const Packing& packing, std::size_t count);

}  // namespace studies
