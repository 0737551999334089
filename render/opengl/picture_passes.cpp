// A pass over the picture for each class of tiles. In final quality nine such passes or more, with the rays moved
// within the pixel, are added up in linear light. In normal quality the pixels that silhouettes of metaballs cross are
// drawn again.
#include "render/opengl/picture_passes.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "render/opengl/frame_uniforms.h"
#include "render/opengl/look_defines.h"
#include "render/picture/pixel_samples.h"

namespace render {

namespace {

constexpr std::size_t kColor = 0;  // index of the only texture of a target

/// Components that tile.vert hands over: the fields of the block Frame and the tile.
constexpr GLint kVaryingComponents = static_cast<GLint>(sizeof(FrameUniforms) / sizeof(float)) + 4;

constexpr std::array kTileClasses = {TileClass::background, TileClass::openGround, TileClass::occludedGround,
                                     TileClass::objects, TileClass::flats};

std::size_t pixelCount(PictureSize size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

bool isPlain(TileClass kind) {
    return kind != TileClass::objects && kind != TileClass::flats;
}

}  // namespace

PicturePasses::PicturePasses(const Gl& gl, PictureSize size, Quality quality)
    : gl_(gl),
      size_(size),
      quality_(quality),
      hasManyVaryings_(limitOf(gl, GL_MAX_VARYING_COMPONENTS) >= kVaryingComponents),
      vertexArray_(generate<VertexArrayName>(gl, gl.GenVertexArrays)),
      frameBlock_(generate<BufferName>(gl, gl.GenBuffers)),
      programs_(gl),
      buffers_(gl),
      silhouettes_(gl),
      picture_(gl, size, {GL_RGBA8}) {
    if (quality != Quality::final) return;
    for (int k = 0; k < 2; ++k) sums_.emplace_back(gl, size, std::initializer_list<GLenum>{GL_RGBA32F});
}

/// Sets what other renderers with the same context may have set otherwise.
void PicturePasses::bindState() const {
    gl_.BindVertexArray(vertexArray_.get());
    gl_.Enable(GL_PROGRAM_POINT_SIZE);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.get());
}

void PicturePasses::upload(const PreparedView& view) {
    uploadMeshes(view);
    buffers_.upload(view, view.meshes.empty() ? std::span<const char>() : meshes_->tiles());
    if (view.hasTransparency) {
        if (!transparency_) transparency_.emplace(gl_);
        transparency_->upload(view);
    }
    if (!view.hasMetaballs) return;
    if (!metaballs_) metaballs_.emplace(gl_, programs_, size_);
    metaballs_->upload(view);
}

void PicturePasses::uploadMeshes(const PreparedView& view) {
    if (view.meshes.empty()) return;
    bindState();
    if (!meshes_) meshes_.emplace(gl_, programs_, size_);
    meshes_->upload(view);
}

bool PicturePasses::drawPicture(const PreparedView& view, const SampleRange& samples,
                                std::vector<std::uint32_t>& pixels) {
    bindState();
    if (!view.meshes.empty()) {
        uploadFrame(view, glm::vec2(0.0F));
        meshes_->drawDepthMap(view);
    }
    const PassOutput output{"", quality_ == Quality::normal ? 4 : 1, {}};
    if (quality_ != Quality::final)
        drawSampling(view, glm::vec2(0.0F), picture_, output);
    else if (!drawMean(view, samples))
        return false;
    pixels.resize(pixelCount(size_));
    gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    if (!view.hasMetaballs || output.samples == 1) return true;
    for (const TileClass kind : {TileClass::objects, TileClass::flats}) drawSilhouettes(view, kind, output, pixels);
    return true;
}

std::vector<glm::vec4> PicturePasses::visiblePoints(const PreparedView& view, PictureSize size) {
    bindState();
    const Target points(gl_, size_, {GL_RGBA32F});
    drawSampling(view, glm::vec2(0.0F), points, {"VISIBLE_POINTS", 1, {}});
    std::vector<glm::vec4> pixels(pixelCount(size));
    gl_.ReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
}

/// Draws the mean of several samplings, each to the target that the next one reads, in this call or in a later one.
/// @return whether these were the last ones, so that the mean is drawn
bool PicturePasses::drawMean(const PreparedView& view, const SampleRange& samples) {
    const auto sumsUpTo = [this](int index) {
        return TextureBinding{"sums", GL_TEXTURE_2D, sums_[static_cast<std::size_t>(index % 2)].texture(kColor)};
    };
    for (int index = samples.begin; index < samples.end; ++index) {
        const PassOutput first{"FIRST_SUM", 1, {}};
        drawSampling(view, pixelSample(index, samples.perAxis).offset, sums_[static_cast<std::size_t>(index % 2)],
                     index == 0 ? first : PassOutput{"SUM", 1, sumsUpTo(index - 1)});
    }
    if (samples.end < samples.count()) return false;
    picture_.bind();
    programs_.get("whole.vert", "mean.frag", {}).use(std::array{sumsUpTo(samples.end - 1)});
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    return true;
}

void PicturePasses::drawSampling(const PreparedView& view, glm::vec2 offset, const Target& target,
                                 const PassOutput& output) {
    uploadFrame(view, offset);
    if (view.hasMetaballs)
        metaballs_->cast(view, definesOf(view, TileClass::objects, output), offset, quality_ == Quality::final);
    if (!view.meshes.empty())
        meshes_->draw(view, output.samples == 4 ? std::span<const glm::vec2>(kFourSamples) : std::span(&offset, 1));
    target.bind();
    for (const TileClass kind : kTileClasses) drawTiles(view, kind, output);
}

/// Draws the tiles of one class to the target that is bound.
void PicturePasses::drawTiles(const PreparedView& view, TileClass kind, const PassOutput& output) {
    const std::span<const std::int32_t> indices = buffers_.tileIndices(kind);
    if (indices.empty()) return;
    Defines defines = definesOf(view, kind, output);
    defines.push_back(fmt::format("POINT_SIZE {}", kTileSize));
    const bool isPoints = std::string_view(output.define) == "VISIBLE_POINTS";
    const ShaderProgram& program =
        programs_.get("tile.vert", isPlain(kind) && !isPoints ? "plain.frag" : "objects.frag", defines);
    std::vector<TextureBinding> textures = texturesOf(view);
    textures.push_back(buffers_.tiles(kind));
    textures.push_back(output.sums);
    program.use(textures);
    const CellLists& tiles = view.sphereTiles;
    setUniforms(view, program);
    program.set("tilesInTarget", static_cast<float>(tiles.columns), static_cast<float>(tiles.rows));
    gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(indices.size()));
}

/// Draws the pixels that silhouettes of metaballs cross again, with a ray for each of their samples. Their alpha is 0.
void PicturePasses::drawSilhouettes(const PreparedView& view, TileClass kind, const PassOutput& output,
                                    std::span<std::uint32_t> pixels) {
    silhouettes_.list([&](std::size_t place) { return pixels[place] >> 24 == 0; }, size_, kTileSize,
                      buffers_.tileIndices(kind));
    if (silhouettes_.empty()) return;
    const PictureSize size = silhouettes_.size();
    if (!samples_ || samples_->size().height < size.height)
        samples_.emplace(gl_, size, std::initializer_list<GLenum>{GL_RGBA8});
    samples_->bind(size);
    Defines defines = definesOf(view, kind, output);
    defines.emplace_back("MARKED");
    const ShaderProgram& program = programs_.get("marked.vert", "objects.frag", defines);
    std::vector<TextureBinding> textures = texturesOf(view);
    textures.push_back(silhouettes_.binding());
    program.use(textures);
    setUniforms(view, program);
    program.set("markedGrid", silhouettes_.grid());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<std::uint32_t> drawn(pixelCount(size));
    gl_.ReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, drawn.data());
    const std::span<const std::int32_t> places = silhouettes_.placesOfPixels();
    for (std::size_t k = 0; k < places.size(); ++k) pixels[static_cast<std::size_t>(places[k])] = drawn[k];
}

void PicturePasses::setUniforms(const PreparedView& view, const ShaderProgram& program) const {
    if (!view.meshes.empty()) meshes_->setUniforms(view, program);
    if (view.hasTransparency) TransparencyBuffers::setUniforms(view, program);
}

void PicturePasses::uploadFrame(const PreparedView& view, glm::vec2 offset) const {
    const FrameUniforms frame = frameUniforms(view, offset);
    gl_.BindBuffer(GL_UNIFORM_BUFFER, frameBlock_.get());
    gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(frame), &frame, GL_STREAM_DRAW);
}

Defines PicturePasses::definesOf(const PreparedView& view, TileClass kind, const PassOutput& output) const {
    Defines defines = lookDefines(view, kind);
    if (hasManyVaryings_) defines.emplace_back("MANY_VARYINGS");
    defines.push_back(fmt::format("SAMPLES {}", output.samples));
    if (*output.define != '\0') defines.emplace_back(output.define);
    return defines;
}

std::vector<TextureBinding> PicturePasses::texturesOf(const PreparedView& view) const {
    std::vector<TextureBinding> textures = buffers_.bindings();
    if (view.hasMetaballs) metaballs_->addBindings(textures);
    if (!view.meshes.empty()) meshes_->addBindings(textures);
    if (!view.hasTransparency) return textures;
    transparency_->addBindings(textures);
    if (!view.meshes.empty()) meshes_->addCorners(textures);
    return textures;
}

}  // namespace render
