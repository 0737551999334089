// The balls whose field is the surface of metaballs: the particles themselves, or what view.h
// (MetaballField) makes of them in other skins, and the law of that field. Called by the preparation of a view and by
// the mesh of the surface.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/picture/symmetric_matrix.h"
#include "render/picture/view.h"

namespace render {

/// A ball of the field, in world coordinates.
struct SkinBall {
    glm::vec3 center{0.0F};
    float weight = 1.0F;  ///< factor of its kernel in the field
    float reach = 1.0F;   ///< radius of its kernel, m
    /// Of an anisotropic skin the inverse of view.h's M, m^2: along a direction n the kernel ends at sqrt(n^T spread
    /// n).
    SymmetricMatrix<float> spread{};
};

/// The kernel of a ball: root(d^2)^2 at distances d below its reach, and 0 beyond.
struct BallKernel {
    float peak = 1.0F;   ///< square root of the ball's weight
    float slope = 1.0F;  ///< fourth root of the weight over the reach, 1/m

    /// The square root of the kernel where that is above zero; zero and below from the ball's reach on.
    /// @param squaredDistance  of a point from the ball's center, m^2
    template <typename Number>
    Number root(Number squaredDistance) const {
        return Number(peak) - squaredDistance * (Number(slope) * Number(slope));
    }
};

/// The kernel of a ball with a weight and a reach above 0.
BallKernel kernelOf(const SkinBall& ball);

/// How far a ball's kernel reaches along each of three axes, m. @param x, y, z  at right angles, of unit length
glm::vec3 extentAlong(const View& view, const SkinBall& ball, glm::vec3 x, glm::vec3 y, glm::vec3 z);

/// The value of the field at the surface of metaballs.
float surfaceThreshold(const MetaballField& field);

/// Makes one ball for each particle; that of a particle whose radius is 0 means nothing. Where no other particle is in
/// reach, the ball stays at its particle, with weight 1 and a round kernel of reach * radius. The result depends on the
/// view alone, bit for bit, not on the number of threads or the instruction set.
std::vector<SkinBall> skinOf(const View& view);

}  // namespace render
