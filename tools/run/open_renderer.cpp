// Opens OpenGL where it is asked for, and names the device in the messages of its failures.
#include "tools/run/open_renderer.h"

#include <utility>

#include <fmt/format.h>

#include "render/picture/system_error.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

OpenedRenderer openOnGl(const RendererChoice& choice, render::PictureSize size, render::Quality quality) {
    auto context = std::make_unique<render::Context>(choice.device);
    auto renderer = std::make_unique<render::Renderer>(*context, size, quality);
    RendererRecord record{kRendererNames[1], context->rendererName(), context->versionName()};
    return {std::move(context), std::move(renderer), std::move(record)};
}

}  // namespace

OpenedRenderer openRenderer(const RendererChoice& choice, render::PictureSize size, render::Quality quality,
                            int threads) {
    if (!choice.isOpenGl)
        return {nullptr, std::make_unique<render::Renderer>(size, quality), {kRendererNames[0], "", ""}};
    prepareMesa(threads);
    try {
        return openOnGl(choice, size, quality);
    } catch (const render::OpenGlError& error) {
        throw render::OpenGlError(
            fmt::format("OpenGL on {} cannot be used: {}", render::nameOf(choice.device), error.what()));
    }
}

}  // namespace tools
