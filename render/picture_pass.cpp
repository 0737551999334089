// The tables behind shaders/picture.frag and the draws over them. Positions are handed to OpenGL relative to the eye.
#include "render/picture_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "render/dimming.h"
#include "render/tile_class.h"
#include "render/tile_table.h"

namespace render {

namespace {

// What the shader of plain tiles reads.
Backdrop backdropOf(const FrameBlock& block) {
    return {block.right,       block.up,           block.forward,       block.picture,
            block.toLight,     block.lightColor,   block.ambientSky,    block.ambientGround,
            block.groundColor, block.groundCenter, block.backgroundTop, block.backgroundBottom,
            block.tone};
}

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& items) {
    return std::as_bytes(std::span<const T>(items));
}

// Whether any term of the shading model looks at openness.
bool asksForOpenness(const View& view) {
    const Surface& surface = view.surface;
    return !view.particles.empty() && (view.ambient.occlusion > 0.0F || surface.reflection > 0.0F ||
                                       surface.translucency > 0.0F || surface.absorption > 0.0F);
}

float meanRadiusOf(const View& view) {
    double sum = 0.0;
    for (const Sphere& particle : view.particles) sum += double(particle.radius);
    return view.particles.empty() ? 0.0F : static_cast<float>(sum / static_cast<double>(view.particles.size()));
}

}  // namespace

PicturePass::PicturePass(const Gl& gl)
    : gl_(&gl),
      programs_(gl),
      boxes_(gl, "boxes", GL_RGBA32F, 16),
      tileTable_(gl, "tiles", GL_RGBA32I, 16),
      pixels_(gl, "pixels", GL_RG32I, 8),
      edgePixels_(gl, "pixels on outlines", GL_RGBA32I, 16),
      fragments_(gl, "things in pixels on outlines", GL_RG32I, 8),
      spheres_(gl, "spheres", GL_RGBA32F, 16),
      sphereLooks_(gl, "looks of spheres", GL_RGBA32UI, 16),
      fieldSamples_(gl, "metaball samples", GL_RGBA32UI, 16),
      lines_(gl, "pixels in tiles with lines", GL_RGBA32F, 16) {
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    frameBlock_ = BufferName(gl, name);
}

void PicturePass::prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times) {
    frame_ = frame;
    light_ = lightBasis(view.light.toLight);
    castsField_ = view.style == Style::metaballs && !view.particles.empty();
    meanRadius_ = meanRadiusOf(view);
    timed(times.bin, [&] { drawn_ = drawnSpheres(view); });
    // None needs what the others find, and each has parts that keep one thread alone busy.
    tbb::parallel_invoke([&] { timed(times.occlusion, [&] { findOpenness(view); }); },
                         [&] { timed(times.bin, [&] { bin(view); }); },
                         [&] { timed(times.shadow, [&] { binShadows(view); }); });
    timed(times.bin, [&] { upload(view); });
    depthMapTexels_ = depthMapTexels;
    timed(times.shadow, [&] { castDepths(view, glm::vec2(0.0F)); });
    timed(times.bin, [&] { findGround(view); });
}

void PicturePass::findGround(const View& view) {
    groundTiles_.assign(sphereTiles_.begin.size() - 1, {});
    if (view.ground) {
        const Dimmers dimmers{light_, lightGrid_, depthMap_, opens_ ? &openMap_ : nullptr, meanRadius_};
        groundTiles_ = groundTiles(frame_, view.ground->height - frame_.eye.y, dimmingOf(view, dimmers));
    }
}

void PicturePass::findOpenness(const View& view) {
    opens_ = asksForOpenness(view);
    particleOpen_.clear();
    openGrid_ = opens_ ? opennessGrid(view.particles) : OpennessGrid{};
    openMap_ = OpennessMap{};
    if (!opens_) return;
    particleOpen_.resize(view.particles.size());
    tbb::parallel_for(std::size_t{0}, view.particles.size(),
                      [&](std::size_t k) { particleOpen_[k] = opennessAt(openGrid_, view.particles[k].center); });
    if (view.ground) openMap_ = opennessAtHeight(openGrid_, view.ground->height);
}

void PicturePass::bin(const View& view) {
    viewSpheres_.resize(drawn_.spheres.size());
    for (std::size_t k = 0; k < viewSpheres_.size(); ++k)
        viewSpheres_[k] = {frame_.toView(drawn_.spheres[k].center + frame_.eye), drawn_.spheres[k].radius};
    spherePixels_ = touchedPixels(frame_, viewSpheres_);
    sphereTiles_ = binToTiles(frame_, viewSpheres_, spherePixels_);
    lineList_ = projectEdges(frame_, view.edges);
    skin_ = castsField_ ? skinOf(view) : std::vector<SkinBall>{};
}

void PicturePass::binShadows(const View& view) {
    lightGrid_ = view.light.shadows ? lightGrid(light_, drawn_.spheres, view.light.softness) : LightGrid{};
}

void PicturePass::castDepths(const View& view, glm::vec2 shift) {
    depthMapShift_ = shift;
    depthMap_ = castsField_ && view.light.shadows ? castDepthMap(light_, {view, skin_, {}}, {depthMapTexels_, shift})
                                                  : DepthMap{};
}

// Rays moved by a third of a pixel look at texels moved by a third of a texel, so that the mean of the pictures has the
// mean of the maps.
void PicturePass::castShadow(const View& view, const Sampling& sampling) {
    if (castsField_ && view.light.shadows && sampling.offset != depthMapShift_) castDepths(view, sampling.offset);
}

void PicturePass::upload(const View& view) {
    spheres_.upload(bytesOf(drawn_.spheres));
    sphereLooks_.upload(bytesOf(looksOf(view, drawn_, particleOpen_)));
    uploadBoxes(view);
}

void PicturePass::uploadBoxes(const View& view) {
    std::vector<glm::vec4> texels;
    for (const BoxObstacle& box : view.boxObstacles) {
        texels.emplace_back(box.minimum - frame_.eye, 0.0F);
        texels.emplace_back(box.maximum - frame_.eye, 0.0F);
        texels.emplace_back(box.color, 0.0F);
    }
    boxes_.upload(bytesOf(texels));
    boxTiles_.assign(sphereTiles_.begin.size() - 1, 0);
    for (const BoxObstacle& box : view.boxObstacles) {
        const auto pixels = pixelsTouchedByBox(frame_, box.minimum, box.maximum);
        if (!pixels) continue;
        for (int row = pixels->y0 / kTileSize; row <= pixels->y1 / kTileSize; ++row) {
            for (int column = pixels->x0 / kTileSize; column <= pixels->x1 / kTileSize; ++column) {
                boxTiles_[sphereTiles_.cellIndex(column, row)] = 1;
            }
        }
    }
}

void PicturePass::castField(const View& view, const Sampling& sampling) {
    if (!castsField_) return;
    castPicture(frame_, {view, skin_, particleOpen_}, {sampling.offset, sampling.samples > 1, sampling.sparse}, field_);
    fieldSamples_.upload(bytesOf(field_.samples));
}

// Whether anything stands in the light's way.
bool PicturePass::castsShadows(const View& view) const {
    return view.light.shadows && (!lightGrid_.empty() || depthMap_.heights.size() > 1 || !view.boxObstacles.empty());
}

Obstruction PicturePass::obstructionOf(const View& view) const {
    Obstruction obstruction;
    obstruction.light = light_;
    obstruction.eye = frame_.eye;
    if (!lightGrid_.empty()) obstruction.spheres = &lightGrid_;
    if (depthMap_.heights.size() > 1) obstruction.field = &depthMap_;
    if (view.light.shadows) obstruction.boxes = view.boxObstacles;
    obstruction.softness = view.light.softness;
    obstruction.meanRadius = meanRadius_;
    if (opens_ && view.ambient.occlusion > 0.0F) {
        obstruction.open = &openGrid_;
        obstruction.ground = &openMap_;
    }
    return obstruction;
}

void PicturePass::look(const View& view, const Sampling& sampling) {
    Solids solids{frame_, viewSpheres_, spherePixels_, &sphereTiles_, view.boxObstacles, std::nullopt};
    if (view.ground) solids.ground = view.ground->height - frame_.eye.y;
    const Surfaces surfaces{frame_,        drawn_.spheres, drawn_.firstObstacle, view.boxObstacles,
                            solids.ground, field_.samples, light_.toLight};
    const Obstruction obstruction = obstructionOf(view);
    const bool dims = castsShadows(view) || obstruction.open != nullptr;
    const TileContents contents{solids,
                                castsField_ ? &field_ : nullptr,
                                lineList_,
                                boxTiles_,
                                groundTiles_,
                                surfaces,
                                dims ? &obstruction : nullptr,
                                sampling.output == Output::surface};
    {
        Mapped pixels = pixels_.map(groundTiles_.size() * kTilePixels * sizeof(Fragment));
        takeSamples(contents, sampling.samples == 1 ? SampleOffsets(&sampling.offset, 1) : kFourSamples,
                    pixels.as<Fragment>(), samples_);
        pixels.finish();
    }
    edgePixels_.upload(bytesOf(samples_.edges));
    fragments_.upload(bytesOf(samples_.fragments));
    lines_.upload(bytesOf(samples_.lines));
}

FrameBlock PicturePass::uploadFrame(const View& view, const Sampling& sampling) {
    const Ground ground = view.ground.value_or(Ground{});
    FrameBlock block;
    block.right = glm::vec4(frame_.right * frame_.halfWidth, frame_.perspective ? 1.0F : 0.0F);
    block.up = glm::vec4(frame_.up * frame_.halfHeight, 0.0F);
    block.forward = glm::vec4(frame_.forward, frame_.pixelWidth());
    block.picture = glm::vec4(1.0F / glm::vec2(frame_.width, frame_.height), sampling.offset);
    block.toLight = glm::vec4(light_.toLight, view.surface.specular);
    block.lightColor = glm::vec4(view.light.color, 0.0F);
    block.ambientSky = glm::vec4(view.ambient.sky, 0.0F);
    block.ambientGround = glm::vec4(view.ambient.ground, 0.0F);
    block.groundColor = glm::vec4(ground.color, ground.height - frame_.eye.y);
    block.groundCenter = glm::vec4(ground.center - frame_.eye, 1.0F / ground.fadeDistance);
    block.backgroundTop = glm::vec4(view.background.top, 0.0F);
    block.backgroundBottom = glm::vec4(view.background.bottom, 0.0F);
    const Surface& surface = view.surface;
    block.material = glm::vec4(surface.reflection, surface.metal, surface.roughness, surface.translucency);
    block.tone = glm::vec4(surface.absorption, surface.glow, view.ambient.occlusion, view.exposure);
    block.mirrorTop = glm::vec4(view.surroundings.top, 0.0F);
    block.mirrorHorizon = glm::vec4(view.surroundings.horizon, 0.0F);
    block.mirrorBottom = glm::vec4(view.surroundings.bottom, 0.0F);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.get());
    gl_->BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    return block;
}

Features PicturePass::featuresOf(const View& view, const Sampling& sampling, int classBits) const {
    Features features;
    features.output = sampling.output;
    features.perspective = frame_.perspective;
    features.spheres = (classBits & kSphereBit) != 0;
    features.obstacles = features.spheres && static_cast<std::size_t>(drawn_.firstObstacle) < drawn_.spheres.size();
    features.field = (classBits & kFieldBit) != 0;
    features.lines = (classBits & kLineBit) != 0;
    features.boxes = (classBits & kBoxBit) != 0;
    features.ground = (classBits & kGroundBit) != 0;
    features.single = showsOneKind(classBits);
    const bool dim = (classBits & kDimBit) != 0;
    features.shadows = dim && castsShadows(view);
    const bool particles = features.field || (features.spheres && view.style == Style::spheres);
    const Surface& surface = view.surface;
    features.specular = particles && (surface.specular > 0.0F || surface.metal > 0.0F);
    features.gloss = features.specular ? surface.glossExponent : 0;
    features.metal = particles && surface.metal > 0.0F;
    features.mirror = particles && surface.reflection > 0.0F;
    features.rough = particles && surface.roughness > 0.0F;
    features.translucent = particles && surface.translucency > 0.0F;
    features.absorbing = particles && surface.absorption > 0.0F;
    features.glow = particles && surface.glow > 0.0F;
    features.occlusion = dim && opens_ && view.ambient.occlusion > 0.0F;
    features.open = opens_ && (features.occlusion || particles);
    features.tone = view.exposure > 0.0F;
    return features;
}

// The class of each tile; 0 for one that the target still holds.
std::vector<std::uint8_t> PicturePass::classesToDraw(const FrameBlock& block, const Sampling& sampling) {
    std::vector<std::uint8_t> classes = samples_.classes;
    if (!sampling.keeps) return classes;
    kept_.begin(backdropOf(block), classes.size());
    for (std::size_t tile = 0; tile < classes.size(); ++tile) {
        const std::uint8_t look = isPlain(classes[tile]) ? classes[tile] : std::uint8_t{0};
        if (kept_.keeps(tile, look)) classes[tile] = 0;
    }
    return classes;
}

void PicturePass::bindAll() const {
    boxes_.bind(kBoxesUnit);
    tileTable_.bind(kTileTableUnit);
    pixels_.bind(kPixelsUnit);
    edgePixels_.bind(kEdgePixelsUnit);
    fragments_.bind(kFragmentsUnit);
    spheres_.bind(kSpheresUnit);
    sphereLooks_.bind(kSphereLooksUnit);
    fieldSamples_.bind(kFieldSamplesUnit);
    lines_.bind(kLinesUnit);
}

GLuint PicturePass::useProgram(const Features& features, PictureSize target) {
    const GLuint program = programs_.picture(features);
    gl_->UseProgram(program);
    programs_.setInteger(program, "targetWidth", target.width);
    programs_.setInteger(program, "targetHeight", target.height);
    return program;
}

void PicturePass::draw(const View& view, const Sampling& sampling, PictureSize target) {
    const FrameBlock block = uploadFrame(view, sampling);
    const TileTable table = tileTable(classesToDraw(block, sampling), sphereTiles_.columns, samples_.lineSlots);
    tileTable_.upload(bytesOf(table.rows));
    bindAll();
    for (int tileClass = 1; tileClass < kClassCount; ++tileClass) {
        const int begin = table.first[static_cast<std::size_t>(tileClass)];
        const int end = table.first[static_cast<std::size_t>(tileClass) + 1];
        if (begin == end) continue;
        Features features = featuresOf(view, sampling, tileClass);
        if (isPlain(tileClass) && sampling.output != Output::surface) features.drawing = Drawing::plain;
        programs_.setInteger(useProgram(features, target), "firstTile", begin);
        gl_->DrawArrays(GL_POINTS, 0, end - begin);
    }
}

void PicturePass::drawEdges(const View& view, const Sampling& sampling, PictureSize target) {
    if (samples_.edges.empty()) return;
    Features features = featuresOf(view, sampling, samples_.edgeClass);
    features.drawing = Drawing::edges;
    programs_.setInteger(useProgram(features, target), "edgeCount", static_cast<int>(samples_.edges.size()));
    const int rows = (static_cast<int>(samples_.edges.size()) + target.width - 1) / target.width;
    gl_->Viewport(0, 0, target.width, rows);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render
