// The baseline that the renderer's times are compared with: the simplest way to draw spheres with OpenGL. Each sphere
// is a quad facing the eye, whose fragment shader intersects the ray with the sphere, writes the depth and lights the
// sphere by the cosine to the light. The baseline shares the OpenGL context with the renderer, but no code.
#pragma once

#include <memory>

#include "render/opengl/context.h"
#include "render/picture/image.h"
#include "render/picture/view.h"

namespace studies {

/// Draws spheres in the simplest way with OpenGL.
class QuadBaseline {
 public:
    /// @param context  OpenGL context to draw with; must outlive the object
    /// @throws render::SystemError
    QuadBaseline(render::Context& context, render::PictureSize size);
    ~QuadBaseline();
    QuadBaseline(const QuadBaseline&) = delete;
    QuadBaseline& operator=(const QuadBaseline&) = delete;

    /// Draws the particles of a view with a perspective camera over a plain background, and reads the picture back.
    /// @param old  an image whose memory is used again, as by Renderer::draw()
    /// @throws render::SystemError
    render::Image draw(const render::View& view, render::Image old = {});

 private:
    struct Resources;
    std::unique_ptr<Resources> resources_;
};

}  // namespace studies
