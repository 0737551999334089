// The balls whose field is the metaballs' surface: the particles themselves, or what view.h's smooth skin makes of
// them. Called by the picture pass once a frame.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// A ball in the world, as heavy as its particle's surroundings are empty.
struct SkinBall {
    glm::vec3 center{0.0F};
    float weight = 1.0F;  ///< of its kernel in the field
};

/// One ball a particle.
/// Holds:  a particle without another in reach stays where it is, with weight 1; the result depends on the view alone,
///         bit for bit, not on the number of threads.
std::vector<SkinBall> skinOf(const View& view);

}  // namespace render
