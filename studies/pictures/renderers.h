// Makes the renderers whose pictures the study of pictures compares. Used for its tables of pictures and of flicker.
#pragma once

#include <memory>
#include <vector>

#include "render/renderer.h"
#include "studies/pictures/pictures.h"

namespace studies {

struct ComparedRenderer {
    RendererKind kind = RendererKind::cpu;
    std::unique_ptr<render::Renderer> renderer;
};

/// The renderer on the CPU, and after it the one in OpenGL if there is a context.
/// @param context  must outlive the renderers; null: none
/// @throws render::SystemError if OpenGL cannot draw pictures of this size
inline std::vector<ComparedRenderer> makeRenderers(render::Context* context, render::PictureSize size,
                                                   render::Quality quality) {
    std::vector<ComparedRenderer> renderers;
    renderers.push_back({RendererKind::cpu, std::make_unique<render::Renderer>(size, quality)});
    if (context != nullptr)
        renderers.push_back({RendererKind::opengl, std::make_unique<render::Renderer>(*context, size, quality)});
    return renderers;
}

}  // namespace studies
