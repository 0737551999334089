// Cubes of particles of one material on a face-centered cubic lattice, packed alike for any number of particles. The
// benchmark and the study of scaling measure times on them.
#pragma once

#include <string>

#include "engine/run/advance.h"

namespace studies {

/// The packing and the motion of the particles in a cube.
struct FccCubeShape {
    double spacing = 1.0;  ///< distance of nearest neighbors, in rest lengths
    double mass = 0.1;     ///< mass of a particle, kg
    double speed = 0.0;    ///< largest magnitude of each random velocity component, m/s
};

/// A cube of particles of a preset material on a face-centered cubic lattice, jittered by 5 % of the spacing, in space
/// without gravity or obstacles.
/// @param count  number of particles, at least 1
engine::Setup fccCube(const std::string& material, std::size_t count, const FccCubeShape& shape);

/// Mean number of other particles within the cutoff of a particle.
double meanNeighbors(const engine::Setup& setup, const engine::Particles& particles);

}  // namespace studies
