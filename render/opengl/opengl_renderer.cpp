// A pass over the picture for each class of tiles. In final quality nine such passes, with the rays moved within the
// pixel, are added up in linear light.
#include "render/opengl/opengl_renderer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "render/opengl/frame_uniforms.h"
#include "render/opengl/context/gl.h"
#include "render/opengl/gl_objects.h"
#include "render/opengl/look_defines.h"
#include "render/opengl/metaball_passes.h"
#include "render/opengl/shader_program.h"
#include "render/opengl/view_buffers.h"
#include "render/picture/image.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

constexpr std::size_t kColor = 0;  // index of the only texture of a target

/// The offsets of the samplings of a picture from the middles of the pixels, pixels.
std::vector<glm::vec2> samplingsOf(Quality quality) {
    if (quality != Quality::final) return {glm::vec2(0.0F)};
    std::vector<glm::vec2> offsets;
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) offsets.push_back(glm::vec2(column, row) / 3.0F);
    return offsets;
}

/// Components that tile.vert hands over: the fields of the block Frame and the tile.
constexpr GLint kVaryingComponents = static_cast<GLint>(sizeof(FrameUniforms) / sizeof(float)) + 4;

constexpr std::array kTileClasses = {TileClass::background, TileClass::openGround, TileClass::occludedGround,
                                     TileClass::objects, TileClass::flats};

bool isPlain(TileClass kind) {
    return kind != TileClass::objects && kind != TileClass::flats;
}

/// What a pass over the picture writes for each pixel.
struct Output {
    const char* define = "";  ///< definition for the shaders; empty for the color, encoded
    int samples = 1;          ///< samples per pixel
    TextureBinding sums{};    ///< with "SUM": the sums of the samplings before
};

/// Everything that lives in the context. The context is current where it is created, used and destroyed.
class Objects {
 public:
    Objects(const Gl& gl, PictureSize size, Quality quality)
        : gl_(gl),
          size_(size),
          quality_(quality),
          hasManyVaryings_(limitOf(gl, GL_MAX_VARYING_COMPONENTS) >= kVaryingComponents),
          vertexArray_(generate<VertexArrayName>(gl, gl.GenVertexArrays)),
          frameBlock_(generate<BufferName>(gl, gl.GenBuffers)),
          programs_(gl),
          buffers_(gl) {
        gl.BindVertexArray(vertexArray_.get());
        gl.Enable(GL_PROGRAM_POINT_SIZE);
        makeTargets(false);
    }

    void upload(const PreparedView& view) {
        buffers_.upload(view);
        if (!view.hasMetaballs) return;
        if (!metaballs_) metaballs_.emplace(gl_, programs_, size_);
        metaballs_->upload(view);
    }

    /// Draws the picture, which is bound to be read back then.
    void drawPicture(const PreparedView& view) {
        makeTargets(view.hasMetaballs && quality_ == Quality::normal);
        if (quality_ == Quality::final) {
            drawMean(view);
            return;
        }
        drawSampling(view, glm::vec2(0.0F), *picture_, {"", quality_ == Quality::normal ? 4 : 1, {}});
    }

    /// The normal and, in w, the view depth of the point that each pixel of a picture shows.
    std::vector<glm::vec4> visiblePoints(const PreparedView& view, PictureSize size) {
        const Target points(gl_, size_, {GL_RGBA32F});
        drawSampling(view, glm::vec2(0.0F), points, {"VISIBLE_POINTS", 1, {}});
        std::vector<glm::vec4> pixels(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
        gl_.ReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, pixels.data());
        return pixels;
    }

 private:
    /// Makes the targets of the picture, with a depth buffer if silhouettes of metaballs need one.
    void makeTargets(bool hasDepth) {
        if (picture_ && hasDepth_ == hasDepth) return;
        hasDepth_ = hasDepth;
        sums_.clear();
        const auto make = [&](GLenum format) {
            return hasDepth ? Target(gl_, size_, {format, GL_DEPTH_COMPONENT32F}) : Target(gl_, size_, {format});
        };
        picture_.emplace(make(GL_RGBA8));
        if (quality_ != Quality::final) return;
        for (int k = 0; k < 2; ++k) sums_.push_back(make(GL_RGBA32F));
    }

    /// Draws the mean of several samplings, each to the target that the next one reads.
    void drawMean(const PreparedView& view) {
        Output output{"FIRST_SUM", 1, {}};
        std::size_t to = 0;
        for (const glm::vec2 offset : samplingsOf(quality_)) {
            drawSampling(view, offset, sums_[to], output);
            output = {"SUM", 1, {"sums", GL_TEXTURE_2D, sums_[to].texture(kColor)}};
            to = 1 - to;
        }
        picture_->bind();
        programs_.get("whole.vert", "mean.frag", {}).use(std::array{output.sums});
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    }

    void drawSampling(const PreparedView& view, glm::vec2 offset, const Target& target, const Output& output) {
        uploadFrame(view, offset);
        if (view.hasMetaballs)
            metaballs_->cast(view, definesOf(view, TileClass::objects), offset, quality_ == Quality::final);
        target.bind();
        const bool hasSilhouettes = view.hasMetaballs && output.samples > 1;
        if (hasSilhouettes) {
            gl_.Enable(GL_DEPTH_TEST);
            gl_.DepthFunc(GL_ALWAYS);
            gl_.DepthMask(GL_TRUE);
        }
        for (const TileClass kind : kTileClasses) drawTiles(view, kind, output, {});
        if (!hasSilhouettes) return;
        // Pixels that a silhouette of metaballs crosses are drawn again. They lie behind the points that are drawn now.
        gl_.DepthFunc(GL_LESS);
        gl_.DepthMask(GL_FALSE);
        for (const TileClass kind : {TileClass::objects, TileClass::flats})
            drawTiles(view, kind, output, {"CAST_SAMPLES", "SEARCHED"});
        gl_.Disable(GL_DEPTH_TEST);
    }

    void uploadFrame(const PreparedView& view, glm::vec2 offset) const {
        const FrameUniforms frame = frameUniforms(view, offset);
        gl_.BindBuffer(GL_UNIFORM_BUFFER, frameBlock_.get());
        gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(frame), &frame, GL_STREAM_DRAW);
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.get());
    }

    Defines definesOf(const PreparedView& view, TileClass kind) const {
        Defines defines = lookDefines(view, kind);
        if (hasManyVaryings_) defines.emplace_back("MANY_VARYINGS");
        return defines;
    }

    /// Draws the tiles of one class to the target that is bound.
    void drawTiles(const PreparedView& view, TileClass kind, const Output& output, const Defines& more) {
        if (buffers_.tileCount(kind) == 0) return;
        Defines defines = definesOf(view, kind);
        defines.push_back(fmt::format("POINT_SIZE {}", kTileSize));
        defines.push_back(fmt::format("SAMPLES {}", output.samples));
        if (*output.define != '\0') defines.emplace_back(output.define);
        defines.insert(defines.end(), more.begin(), more.end());
        const bool isPoints = std::string_view(output.define) == "VISIBLE_POINTS";
        const ShaderProgram& program =
            programs_.get("tile.vert", isPlain(kind) && !isPoints ? "plain.frag" : "objects.frag", defines);
        std::vector<TextureBinding> textures = buffers_.bindings();
        textures.push_back(buffers_.tiles(kind));
        textures.push_back(output.sums);
        if (view.hasMetaballs) metaballs_->addBindings(textures);
        program.use(textures);
        const CellLists& tiles = view.sphereTiles;
        program.set("tilesInTarget", static_cast<float>(tiles.columns), static_cast<float>(tiles.rows));
        gl_.DrawArrays(GL_POINTS, 0, buffers_.tileCount(kind));
    }

    const Gl& gl_;
    PictureSize size_;  // in whole tiles
    Quality quality_;
    bool hasManyVaryings_;  // whether the vertex shader can hand the block Frame over
    VertexArrayName vertexArray_;
    BufferName frameBlock_;
    ShaderPrograms programs_;
    ViewBuffers buffers_;
    std::optional<MetaballPasses> metaballs_;
    bool hasDepth_ = false;
    std::optional<Target> picture_;  // sRGB pixels
    std::vector<Target> sums_;       // in final quality: sums of linear colors, of which one is read and one is written
};

class OpenGlRenderer final : public ViewRenderer {
 public:
    OpenGlRenderer(Context& context, PictureSize size, Quality quality);
    ~OpenGlRenderer() override;

    Image draw(const PreparedView& view, Image image, DrawTimes& times) override;
    std::vector<VisiblePoint> visiblePoints(const PreparedView& view) override;

 private:
    Context& context_;
    PictureSize size_;
    std::unique_ptr<Objects> objects_;
    std::vector<std::uint32_t> pixels_;
};

OpenGlRenderer::OpenGlRenderer(Context& context, PictureSize size, Quality quality) : context_(context), size_(size) {
    const CurrentContext current(context);
    const PictureSize padded{kTileSize * tilesAlong(size.width), kTileSize * tilesAlong(size.height)};
    objects_ = std::make_unique<Objects>(context.gl(), padded, quality);
    checkGl(context.gl(), "setting the renderer up");
}

OpenGlRenderer::~OpenGlRenderer() {
    try {
        const CurrentContext current(context_);
        objects_.reset();
    } catch (const SystemError&) {
        // OpenGL objects cannot be deleted without their context. They are freed together with the context.
        static_cast<void>(objects_.release());
    }
}

Image OpenGlRenderer::draw(const PreparedView& view, Image image, DrawTimes& times) {
    const CurrentContext current(context_);
    const Gl& gl = context_.gl();
    timed(times.upload, [&] { objects_->upload(view); });
    timed(times.color, [&] {
        objects_->drawPicture(view);
        gl.Finish();
    });
    timed(times.readBack, [&] {
        pixels_.resize(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height));
        gl.ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
        checkGl(gl, "drawing a frame");
        image = packedImage(size_, pixels_, size_.width, std::move(image));
    });
    return image;
}

std::vector<VisiblePoint> OpenGlRenderer::visiblePoints(const PreparedView& view) {
    const CurrentContext current(context_);
    objects_->upload(view);
    const std::vector<glm::vec4> pixels = objects_->visiblePoints(view, size_);
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
