// What the module with OpenEXR gives to the program, which loads it when the first file is asked for (exr.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/layers.h"

namespace render {

/// The functions of exr.h as exr_openexr.cpp has them.
struct OpenExrModule {
    const char* version;
    std::vector<std::uint8_t> (*encode)(PictureSize size, const Layers& layers);
};

}  // namespace render

/// Found in the module by its name.
extern "C" const render::OpenExrModule globularOpenExr;
