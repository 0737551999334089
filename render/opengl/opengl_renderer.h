// The renderer in OpenGL's shaders, which find and color every pixel.
#pragma once

#include <memory>

#include "render/opengl/context/context.h"
#include "render/prepare/view_renderer.h"

namespace render {

/// Makes the renderer. Its functions throw OpenGlError if OpenGL fails.
/// @param context  must outlive the renderer
/// @throws OpenGlError if OpenGL cannot draw pictures of this size, or the build has no OpenGL
std::unique_ptr<ViewRenderer> makeOpenGlRenderer(Context& context, PictureSize size, Quality quality);

}  // namespace render
