// The baseline of the study of pictures: spheres as what one would write first, a quad for each that faces the eye, its
// sphere found and its depth written by the fragment shader, lit by the light's cosine and nothing else. Shares the
// context, but no pass, with the renderer.
#pragma once

#include <memory>

#include "render/opengl/context.h"
#include "render/picture/image.h"
#include "render/picture/view.h"

namespace studies {

class QuadBaseline {
 public:
    /// The context must outlive it.
    QuadBaseline(render::Context& context, render::PictureSize size);
    ~QuadBaseline();
    QuadBaseline(const QuadBaseline&) = delete;
    QuadBaseline& operator=(const QuadBaseline&) = delete;

    /// The particles of a view in perspective over a plain background, read back. Throws render::SystemError.
    /// old: as Renderer::draw() has it.
    render::Image draw(const render::View& view, render::Image old = {});

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace studies
