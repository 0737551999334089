// Blocks of one material to measure on: as many particles as one likes, packed alike. Used by the benchmarks and by the
// study of scaling.
#pragma once

#include <string>

#include "engine/run/advance.h"

namespace studies {

/// How a block is packed and moves.
struct FccCubeShape {
    double spacing = 1.0;  ///< of nearest neighbors, in rest lengths
    double mass = 0.1;     ///< of a particle, kg
    double speed = 0.0;    ///< each component of a velocity is up to this, at random, m/s
};

/// A close packing of a preset material in a cube, a little shaken, without gravity. Shape: at least 1 particle.
engine::Setup fccCube(const std::string& material, std::size_t count, const FccCubeShape& shape);

/// Mean number of others within the cutoff of a particle.
double meanNeighbors(const engine::Setup& setup, const engine::Particles& particles);

}  // namespace studies
