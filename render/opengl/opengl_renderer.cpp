// Makes the context current for each picture, and gives the passes' pixels the shape of an image.
#include "render/opengl/opengl_renderer.h"

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/opengl/context/gl.h"
#include "render/opengl/picture_passes.h"
#include "render/picture/image.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

class OpenGlRenderer final : public ViewRenderer {
 public:
    OpenGlRenderer(Context& context, PictureSize size, Quality quality);
    ~OpenGlRenderer() override;

    void draw(const PreparedView& view, const SampleRange& samples, const LayerSelection& wanted, Layers& layers,
              DrawTimes& times) override;

 private:
    void drawImage(const PreparedView& view, const SampleRange& samples, Image& image, DrawTimes& times);
    std::vector<VisiblePoint> visiblePoints(const PreparedView& view);

    Context& context_;
    PictureSize size_;
    std::unique_ptr<PicturePasses> passes_;
    std::vector<std::uint32_t> pixels_;
};

OpenGlRenderer::OpenGlRenderer(Context& context, PictureSize size, Quality quality) : context_(context), size_(size) {
    const CurrentContext current(context);
    const PictureSize padded{kTileSize * tilesAlong(size.width), kTileSize * tilesAlong(size.height)};
    passes_ = std::make_unique<PicturePasses>(context.gl(), padded, quality);
    checkGl(context.gl(), "setting the renderer up");
}

OpenGlRenderer::~OpenGlRenderer() {
    try {
        const CurrentContext current(context_);
        passes_.reset();
    } catch (const OpenGlError&) {
        // OpenGL objects cannot be deleted without their context. They are freed together with the context.
        static_cast<void>(passes_.release());
    }
}

void OpenGlRenderer::draw(const PreparedView& view, const SampleRange& samples, const LayerSelection& wanted,
                          Layers& layers, DrawTimes& times) {
    if (wanted.color || wanted.ids) throw std::logic_error("render: OpenGL draws no colors with alpha and no ids");
    const CurrentContext current(context_);
    timed(times.upload, [&] { passes_->upload(view); });
    if (wanted.image) drawImage(view, samples, layers.image, times);
    if (wanted.points) timed(times.color, [&] { layers.points = visiblePoints(view); });
}

void OpenGlRenderer::drawImage(const PreparedView& view, const SampleRange& samples, Image& image, DrawTimes& times) {
    bool isComplete = false;
    timed(times.color, [&] { isComplete = passes_->drawPicture(view, samples, pixels_); });
    checkGl(context_.gl(), "drawing a frame");
    if (!isComplete) return;
    const int rowLength = passes_->size().width;
    timed(times.readBack, [&] { image = packedImage(size_, pixels_, rowLength, std::move(image)); });
}

std::vector<VisiblePoint> OpenGlRenderer::visiblePoints(const PreparedView& view) {
    const std::vector<glm::vec4> pixels = passes_->visiblePoints(view, size_);
    checkGl(context_.gl(), "drawing the points of surfaces");
    std::vector<VisiblePoint> found(pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) found[k] = {glm::vec3(pixels[k]), pixels[k].w};
    return found;
}

}  // namespace

std::unique_ptr<ViewRenderer> makeOpenGlRenderer(Context& context, PictureSize size, Quality quality) {
    return std::make_unique<OpenGlRenderer>(context, size, quality);
}

}  // namespace render
