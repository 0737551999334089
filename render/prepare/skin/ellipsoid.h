// The balls of an anisotropic skin as the quadratic forms that rays are cast at.
#pragma once

#include <glm/glm.hpp>

#include "render/picture/symmetric_matrix.h"

namespace render {

/// The shape of a ball of an anisotropic skin. Its kernel is (peak - d^T form d)^2, d the vector from its center in
/// view coordinates, where that root is above zero.
struct Ellipsoid {
    SymmetricMatrix<float> form;  ///< peak times view.h's M, 1/m^2
    float radius = 1.0F;          ///< of a sphere around the kernel, m; at most a tenth longer than its longest axis
};

/// The shape of a ball.
/// @param spread  as in SkinBall, along any axes, which are those of the result
/// @param peak    square root of the ball's weight
Ellipsoid ellipsoidOf(const SymmetricMatrix<double>& spread, float peak);

/// A matrix in single precision.
SymmetricMatrix<float> inFloat(const SymmetricMatrix<double>& m);

}  // namespace render
