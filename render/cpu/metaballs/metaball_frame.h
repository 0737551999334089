// The metaballs of one view, cast: samples of their surface for the picture. Called by the picture pass.
#pragma once

#include <glm/glm.hpp>

#include "render/cpu/metaballs/binned_field.h"
#include "render/cpu/metaballs/field_picture.h"
#include "render/picture/camera_frame.h"

namespace render {

/// Where in the pixel the rays go.
struct FieldSampling {
    glm::vec2 offset{0.0F};        ///< of the one sample, in pixels from the middle
    bool extraAtOutlines = false;  ///< four samples where neighbors differ
    bool sparse = false;  ///< every second pixel of every second row is cast, others where the surface is not smooth
};

/// The field is binned from this frame and skin. Overwrites `picture`, whose memory is used again.
void castPicture(const CameraFrame& frame, const Skinned& skin, const BinnedField& field, const FieldSampling& sampling,
                 FieldPicture& picture);

}  // namespace render
