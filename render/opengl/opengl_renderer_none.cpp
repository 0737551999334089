// The OpenGL renderer of a build without OpenGL. There is no context that it could be made for.
#include <stdexcept>

#include "render/opengl/opengl_renderer.h"

namespace render {

std::unique_ptr<ViewRenderer> makeOpenGlRenderer(Context&, PictureSize, Quality) {
    throw std::logic_error("render: there is no OpenGL renderer in this build");
}

}  // namespace render
