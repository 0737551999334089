// Makes the renderer of a run, with the OpenGL context that it may need. Called by everything that draws.
#pragma once

#include <memory>

#include "render/opengl/context/context.h"
#include "render/renderer.h"
#include "tools/run/options.h"
#include "tools/run/run_report.h"

namespace tools {

/// Its members are constant because an assignment would destroy the old context before its renderer.
struct OpenedRenderer {
    const std::unique_ptr<render::Context> context;  ///< null for the renderer on the CPU
    const std::unique_ptr<render::Renderer> renderer;
    const RendererRecord record;
};

/// Makes a renderer for pictures of one size and quality.
/// @param threads  number of threads for Mesa's software renderer, unless LP_NUM_THREADS says otherwise
/// @throws render::OpenGlError if OpenGL cannot be used
OpenedRenderer openRenderer(const RendererChoice& choice, render::PictureSize size, render::Quality quality,
                            int threads);

/// The renderer of a job.
inline OpenedRenderer openRenderer(const DrawJob& job) {
    return openRenderer(job.renderer, job.scene->size, job.quality, job.threads);
}

}  // namespace tools
