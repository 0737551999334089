// The balls whose field is the surface of metaballs: the particles themselves, or for a smooth skin what view.h
// (MetaballField) makes of them. Called by the preparation of a view.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// A ball of the field, in world coordinates.
struct SkinBall {
    glm::vec3 center{0.0F};
    float weight = 1.0F;  ///< factor of its kernel in the field
    float reach = 1.0F;   ///< radius of its kernel, m
};

/// Makes one ball for each particle; that of a particle whose radius is 0 means nothing. Where no other particle is in
/// reach, the ball stays at its particle, with weight 1 and a kernel of reach * radius. The result depends on the view
/// alone, bit for bit, not on the number of threads or the instruction set.
std::vector<SkinBall> skinOf(const View& view);

}  // namespace render
