// Beer's law. Used by light_path.cpp.
#pragma once

#include <algorithm>

#include <glm/glm.hpp>

#include "render/picture/shading_model.h"
#include "render/prepare/lighting/portable_exponentials.h"

namespace render {

/// The share of light that is left after a length of way through a medium, by section 6 of shading_model.h.
/// @param color   of the medium, linear RGB
/// @param length  m
inline glm::vec3 attenuation(const Medium& medium, glm::vec3 color, float length) {
    glm::vec3 share;
    for (int channel = 0; channel < 3; ++channel)
        share[channel] =
            exp2Of(log2Of(std::clamp(color[channel], kDarkestMedium, 1.0F)) * (length / medium.attenuationDistance));
    return share;
}

}  // namespace render
