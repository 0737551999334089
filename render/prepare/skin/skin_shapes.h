// The shapes and the shifts of an anisotropic skin's balls: covariances of the particles around each, from twice as far
// as the balls' kernels reach. Called by skin.cpp, which makes the balls.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/picture/symmetric_matrix.h"
#include "render/prepare/skin/particle_cells.h"

namespace render {

/// What a particle's neighbors within twice the reach make of its ball, in the terms of view.h's anisotropic skin.
struct NeighborShape {
    glm::vec3 shift{0.0F};               ///< m, m
    SymmetricMatrix<double> covariance;  ///< C, whose trace is 3
};

/// The shapes of all particles, by their sorted index: the same bits on every instruction set and by any number of
/// threads. @param reach  reach of the field, in radii
std::vector<NeighborShape> neighborShapes(const ParticleCells& cells, float reach);

/// The inverse of M of a ball whose neighbors have this covariance, m^2.
/// @param covariance  C of view.h, with a trace of 3
/// @param stretch     s of view.h, from 0 to kSkinStretch
/// @param reach       R of view.h, m
SymmetricMatrix<float> spreadOf(const SymmetricMatrix<double>& covariance, float stretch, float reach);

}  // namespace render
