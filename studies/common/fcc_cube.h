// Cubes of one material on a face-centered cubic lattice, with any number of particles packed alike: what the benchmark
// and the study of scaling measure on.
#pragma once

#include <string>

#include "engine/run/advance.h"

namespace studies {

/// How a cube is packed and moves.
struct FccCubeShape {
    double spacing = 1.0;  ///< of nearest neighbors, in rest lengths
    double mass = 0.1;     ///< of a particle, kg
    double speed = 0.0;    ///< bound of each random velocity component, m/s
};

/// A preset material on the lattice, jittered by 5 % of the spacing, in space without gravity or obstacles.
/// @param count  number of particles, at least 1
engine::Setup fccCube(const std::string& material, std::size_t count, const FccCubeShape& shape);

/// Mean number of neighbors within a particle's cutoff, the particle itself excluded.
double meanNeighbors(const engine::Setup& setup, const engine::Particles& particles);

}  // namespace studies
