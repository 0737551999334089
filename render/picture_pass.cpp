// The tables behind shaders/picture.frag and the draws over them. Positions are handed to OpenGL relative to the eye.
#include "render/picture_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/tile_class.h"

namespace render {

namespace {

// What the shader of plain tiles reads.
Backdrop backdropOf(const FrameBlock& block) {
    return {block.right,       block.up,           block.forward,       block.picture,
            block.toLight,     block.lightColor,   block.ambientSky,    block.ambientGround,
            block.groundColor, block.groundCenter, block.backgroundTop, block.backgroundBottom,
            block.tone};
}

struct TileRow {
    std::int32_t column, row, sphereBegin, sphereEnd, fieldSlot, lineBegin, lineEnd, unused;
};

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& items) {
    return std::as_bytes(std::span<const T>(items));
}

std::int32_t beginOf(const CellLists& lists, std::size_t cell) {
    return static_cast<std::int32_t>(lists.begin[cell]);
}

DrawnSpheres drawnSpheres(const View& view, std::span<const Openness> open) {
    DrawnSpheres drawn;
    const auto add = [&](glm::vec3 center, float radius, glm::vec3 color, float particle) {
        drawn.spheres.push_back({center - view.camera.eye, radius});
        drawn.colors.emplace_back(color, particle);
    };
    if (view.style == Style::spheres) {
        for (std::size_t k = 0; k < view.particles.size(); ++k) {
            const Sphere& s = view.particles[k];
            if (!(s.radius > 0.0F)) continue;
            add(s.center, s.radius, s.color, 1.0F);
            if (open.empty()) continue;
            drawn.open.emplace_back(open[k][0], open[k][2], open[k][4], 0.0F);
            drawn.open.emplace_back(open[k][1], open[k][3], open[k][5], 0.0F);
        }
    }
    for (const SphereObstacle& s : view.sphereObstacles)
        if (s.radius > 0.0F) add(s.center, s.radius, s.color, 0.0F);
    return drawn;
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
      tileSpheres_(gl, "spheres in tiles", GL_RGBA32F, 16),
      tileSphereIds_(gl, "sphere indices in tiles", GL_R32I, 4),
      sphereColors_(gl, "sphere colours", GL_RGBA32F, 16),
      fieldSamples_(gl, "metaball samples", GL_RGBA32UI, 16),
      lightLists_(gl, "cells of the light's grid", GL_RG32I, 8),
      lightSpheres_(gl, "shadow casters in cells", GL_RGBA32F, 16),
      lightDepths_(gl, "texels of the light's depth map", GL_R32F, 4),
      lines_(gl, "lines", GL_RGBA32F, 16),
      lineLists_(gl, "lines in tiles", GL_R32I, 4),
      sphereOpen_(gl, "openness of spheres", GL_RGBA32F, 16),
      fieldOpen_(gl, "openness of metaball samples", GL_R32UI, 4),
      gridOpen_(gl, "cubes of openness", GL_R32F, 4),
      groundOpen_(gl, "openness of the ground", GL_R32F, 4) {
    GLuint name = 0;
    gl.GenBuffers(1, &name);
    frameBlock_ = BufferName(gl, name);
}

void PicturePass::prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times) {
    StageClock clock;
    frame_ = frame;
    light_ = lightBasis(view.light.toLight);
    castsField_ = view.style == Style::metaballs && !view.particles.empty();
    fieldSlots_.clear();
    meanRadius_ = meanRadiusOf(view);
    findOpenness(view);
    clock.add(times.occlusion);
    skin_ = castsField_ ? skinOf(view) : std::vector<SkinBall>{};
    binSpheres(view);
    uploadLines(view);
    uploadBoxes(view);
    clock.add(times.bin);
    depthMapTexels_ = depthMapTexels;
    castLight(view);
    clock.add(times.shadow);
    sortGround(view);
    clock.add(times.bin);
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
    groundOpen_.upload(bytesOf(openMap_.values));
    if (view.boxObstacles.empty() && view.sphereObstacles.empty()) return;
    std::vector<float> all;
    for (const std::vector<float>& values : openGrid_.values) all.insert(all.end(), values.begin(), values.end());
    gridOpen_.upload(bytesOf(all));
}

void PicturePass::binSpheres(const View& view) {
    drawn_ = drawnSpheres(view, particleOpen_);
    std::vector<ViewSphere> seen(drawn_.spheres.size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
        seen[k] = {frame_.toView(drawn_.spheres[k].center + frame_.eye), drawn_.spheres[k].radius};
    }
    sphereTiles_ = binToTiles(frame_, seen);
    std::vector<glm::vec4> entries(sphereTiles_.items.size());
    tbb::parallel_for(std::size_t{0}, entries.size() / 4096 + 1, [&](std::size_t chunk) {
        for (std::size_t k = chunk * 4096; k < std::min((chunk + 1) * 4096, entries.size()); ++k) {
            const ViewSphere& sphere = drawn_.spheres[sphereTiles_.items[k]];
            entries[k] = glm::vec4(sphere.center, sphere.radius);
        }
    });
    tileSpheres_.upload(bytesOf(entries));
    tileSphereIds_.upload(bytesOf(sphereTiles_.items));
    sphereColors_.upload(bytesOf(drawn_.colors));
    sphereOpen_.upload(bytesOf(drawn_.open));
}

void PicturePass::castLight(const View& view) {
    lightGrid_ = view.light.shadows ? lightGrid(light_, drawn_.spheres, view.light.softness) : LightGrid{};
    lightLists_.upload(bytesOf(lightGrid_.cells));
    lightSpheres_.upload(bytesOf(lightGrid_.spheres));
    castDepths(view, glm::vec2(0.0F));
}

void PicturePass::castDepths(const View& view, glm::vec2 shift) {
    depthMapShift_ = shift;
    depthMap_ = castsField_ && view.light.shadows ? castDepthMap(light_, {view, skin_, {}}, {depthMapTexels_, shift})
                                                  : DepthMap{};
    lightDepths_.upload(bytesOf(depthMap_.heights));
}

// Rays moved by a third of a pixel look at texels moved by a third of a texel, so that the mean of the pictures has the
// mean of the maps.
void PicturePass::castShadow(const View& view, const Sampling& sampling) {
    if (castsField_ && view.light.shadows && sampling.offset != depthMapShift_) castDepths(view, sampling.offset);
}

void PicturePass::uploadLines(const View& view) {
    lineList_ = projectEdges(frame_, view.edges);
    lines_.upload(bytesOf(lineList_.lines));
    lineLists_.upload(bytesOf(lineList_.tiles.items));
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

void PicturePass::sortGround(const View& view) {
    groundTiles_.assign(sphereTiles_.begin.size() - 1, {});
    if (!view.ground) return;
    Dimming dimming;
    dimming.light = light_;
    if (view.light.shadows) {
        glm::vec2 low(std::numeric_limits<float>::max());
        glm::vec2 high(std::numeric_limits<float>::lowest());
        const auto cover = [&](glm::vec2 first, glm::vec2 last) {
            low = min(low, first);
            high = max(high, last);
        };
        const glm::vec2 gridSize(lightGrid_.columns, lightGrid_.rows);
        if (!lightGrid_.spheres.empty()) cover(lightGrid_.origin, lightGrid_.origin + lightGrid_.cellSize * gridSize);
        const glm::vec2 mapSize(depthMap_.columns, depthMap_.rows);
        // A texel more on each side: the map may be shifted.
        const float texel = depthMap_.texelSize;
        if (depthMap_.heights.size() > 1) cover(depthMap_.origin - texel, depthMap_.origin + texel * (mapSize + 1.0F));
        for (const BoxObstacle& box : view.boxObstacles) {
            // Half the width of an edge: a soft one's, or a pixel's, which far away is wider than anything.
            const glm::vec3 size = box.maximum - box.minimum;
            const float edge = view.light.softness * meanRadius_ + 0.5F * length(size);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 at = box.minimum + size * glm::vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
                const glm::vec2 on(light_.toLightSpace(at - frame_.eye));
                cover(on - edge, on + edge);
            }
        }
        dimming.shadowLow = low;
        dimming.shadowHigh = high;
    }
    if (opens_ && view.ambient.occlusion > 0.0F) {
        dimming.openLow = openMap_.origin - glm::vec2(frame_.eye.x, frame_.eye.z);
        dimming.openHigh = dimming.openLow + openMap_.side * glm::vec2(openMap_.columns, openMap_.rows);
    }
    groundTiles_ = groundTiles(frame_, view.ground->height - frame_.eye.y, dimming);
}

void PicturePass::castField(const View& view, const Sampling& sampling) {
    if (!castsField_) return;
    const FieldPicture picture =
        castPicture(frame_, {view, skin_, particleOpen_}, {sampling.offset, sampling.samples > 1});
    fieldSlots_ = picture.slots;
    fieldFarthest_ = picture.farthest;
    fieldSamples_.upload(bytesOf(picture.samples));
    fieldOpen_.upload(bytesOf(picture.open));
}

FrameBlock PicturePass::uploadFrame(const View& view, const Sampling& sampling) {
    const Ground ground = view.ground.value_or(Ground{});
    const float perspective = frame_.perspective ? 1.0F : 0.0F;
    FrameBlock block;
    block.right = glm::vec4(frame_.right * frame_.halfWidth, perspective);
    block.up = glm::vec4(frame_.up * frame_.halfHeight, 0.0F);
    block.forward = glm::vec4(frame_.forward, frame_.pixelWidth());
    block.picture = glm::vec4(frame_.width, frame_.height, sampling.offset);
    block.toLight = glm::vec4(light_.toLight, view.surface.specular);
    block.lightColor = glm::vec4(view.light.color, 0.0F);
    block.ambientSky = glm::vec4(view.ambient.sky, 0.0F);
    block.ambientGround = glm::vec4(view.ambient.ground, 0.0F);
    block.groundColor = glm::vec4(ground.color, ground.height - frame_.eye.y);
    block.groundCenter = glm::vec4(ground.center - frame_.eye, ground.fadeDistance);
    block.backgroundTop = glm::vec4(view.background.top, 0.0F);
    block.backgroundBottom = glm::vec4(view.background.bottom, 0.0F);
    block.lightU = glm::vec4(light_.u, 0.0F);
    block.lightV = glm::vec4(light_.v, 0.0F);
    block.lightGrid = glm::vec4(lightGrid_.origin, 1.0F / lightGrid_.cellSize, 0.0F);
    block.lightCells = glm::ivec4(lightGrid_.columns, lightGrid_.rows, depthMap_.columns, depthMap_.rows);
    block.depthMap = glm::vec4(depthMap_.origin, 1.0F / depthMap_.texelSize, depthMap_.texelSize);
    block.counts = glm::ivec4(view.boxObstacles.size(), view.surface.glossExponent, 0, 0);
    const Surface& surface = view.surface;
    block.material = glm::vec4(surface.reflection, surface.metal, surface.roughness, surface.translucency);
    block.tone = glm::vec4(surface.absorption, surface.glow, view.ambient.occlusion, view.exposure);
    block.mirrorTop = glm::vec4(view.surroundings.top, 0.0F);
    block.mirrorHorizon = glm::vec4(view.surroundings.horizon, 0.0F);
    block.mirrorBottom = glm::vec4(view.surroundings.bottom, 0.0F);
    block.openGrid = glm::vec4(openGrid_.origin - frame_.eye, 1.0F / openGrid_.side);
    block.openCells = glm::ivec4(openGrid_.cells, openMap_.columns);
    block.openMap =
        glm::vec4(openMap_.origin - glm::vec2(frame_.eye.x, frame_.eye.z), 1.0F / openMap_.side, openMap_.rows);
    block.soft = glm::vec4(view.light.softness, meanRadius_, 0.0F, 0.0F);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.get());
    gl_->BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    return block;
}

Features PicturePass::featuresOf(const View& view, const Sampling& sampling, int tileClass) const {
    Features features;
    features.plain = isPlain(tileClass) && sampling.output != Output::surface;
    features.samples = hasOutlines(tileClass) ? sampling.samples : 1;
    features.output = sampling.output;
    features.spheres = (tileClass & kSphereBit) != 0;
    features.field = (tileClass & kFieldBit) != 0;
    features.lines = (tileClass & kLineBit) != 0;
    features.boxes = (tileClass & kBoxBit) != 0;
    features.ground = (tileClass & kGroundBit) != 0;
    const bool dim = (tileClass & kDimBit) != 0;
    features.lightSpheres = dim && !lightGrid_.spheres.empty();
    features.lightField = dim && depthMap_.heights.size() > 1;
    features.lightBoxes = dim && view.light.shadows && !view.boxObstacles.empty();
    features.shadows = features.lightSpheres || features.lightField || features.lightBoxes;
    features.soft = features.shadows && view.light.softness > 0.0F;
    const bool particles = features.field || (features.spheres && view.style == Style::spheres);
    const Surface& surface = view.surface;
    features.specular = particles && (surface.specular > 0.0F || surface.metal > 0.0F);
    features.metal = particles && surface.metal > 0.0F;
    features.mirror = particles && surface.reflection > 0.0F;
    features.rough = particles && surface.roughness > 0.0F;
    features.translucent = particles && surface.translucency > 0.0F;
    features.absorbing = particles && surface.absorption > 0.0F;
    features.glow = particles && surface.glow > 0.0F;
    features.occlusion = dim && opens_ && view.ambient.occlusion > 0.0F;
    features.open = opens_ && (features.occlusion || particles);
    features.openObstacles =
        features.occlusion && (features.boxes || (features.spheres && !view.sphereObstacles.empty()));
    features.tone = view.exposure > 0.0F;
    return features;
}

int PicturePass::classOf(std::size_t tile) const {
    int bits = 0;
    if (sphereTiles_.begin[tile + 1] > sphereTiles_.begin[tile]) bits |= kSphereBit;
    if (!fieldSlots_.empty() && fieldSlots_[tile] >= 0) bits |= kFieldBit;
    if (lineList_.tiles.begin[tile + 1] > lineList_.tiles.begin[tile]) bits |= kLineBit;
    if (boxTiles_[tile] != 0) bits |= kBoxBit;
    const GroundTile& ground = groundTiles_[tile];
    if (bits == kFieldBit && fieldFarthest_[tile] < ground.nearest) return kFieldBit | kWholeBit | kDimBit;
    if (ground.kind != GroundKind::none) bits |= kGroundBit;
    if (ground.kind == GroundKind::horizon) bits |= kHorizonBit;
    const bool surfaces = (bits & (kSphereBit | kFieldBit | kBoxBit)) != 0;
    if (surfaces || ground.kind == GroundKind::dimmed || ground.kind == GroundKind::horizon) bits |= kDimBit;
    return bits;
}

// The class of each tile; kClassCount for one that the target still holds.
std::vector<int> PicturePass::classesOfTiles(const FrameBlock& block, const Sampling& sampling) {
    std::vector<int> classes(sphereTiles_.begin.size() - 1);
    for (std::size_t tile = 0; tile < classes.size(); ++tile) classes[tile] = classOf(tile);
    if (!sampling.keeps) return classes;
    kept_.begin(backdropOf(block), classes.size());
    for (std::size_t tile = 0; tile < classes.size(); ++tile) {
        const int look = isPlain(classes[tile]) ? 1 + classes[tile] : 0;
        if (kept_.keeps(tile, static_cast<std::uint8_t>(look))) classes[tile] = kClassCount;
    }
    return classes;
}

// Rows of the table class by class; returns how many rows come before each class, and the number of all.
std::vector<int> PicturePass::uploadTileTable(const std::vector<int>& classes) {
    std::vector<int> first(kClassCount + 2, 0);
    for (const int tileClass : classes) ++first[static_cast<std::size_t>(tileClass) + 1];
    for (std::size_t c = 0; c <= kClassCount; ++c) first[c + 1] += first[c];
    std::vector<TileRow> rows(classes.size());
    std::vector<int> next = first;
    for (std::size_t tile = 0; tile < classes.size(); ++tile) {
        const auto columns = static_cast<std::size_t>(sphereTiles_.columns);
        rows[static_cast<std::size_t>(next[static_cast<std::size_t>(classes[tile])]++)] = {
            static_cast<std::int32_t>(tile % columns),
            static_cast<std::int32_t>(tile / columns),
            beginOf(sphereTiles_, tile),
            beginOf(sphereTiles_, tile + 1),
            fieldSlots_.empty() ? -1 : fieldSlots_[tile],
            beginOf(lineList_.tiles, tile),
            beginOf(lineList_.tiles, tile + 1),
            0};
    }
    tileTable_.upload(bytesOf(rows));
    return first;
}

void PicturePass::draw(const View& view, const Sampling& sampling, PictureSize target) {
    const FrameBlock block = uploadFrame(view, sampling);
    const std::vector<int> first = uploadTileTable(classesOfTiles(block, sampling));
    boxes_.bind(kBoxesUnit);
    tileTable_.bind(kTileTableUnit);
    tileSpheres_.bind(kTileSpheresUnit);
    tileSphereIds_.bind(kTileSphereIdsUnit);
    sphereColors_.bind(kSphereColorsUnit);
    fieldSamples_.bind(kFieldSamplesUnit);
    lightLists_.bind(kLightListsUnit);
    lightSpheres_.bind(kLightSpheresUnit);
    lightDepths_.bind(kLightDepthsUnit);
    lines_.bind(kLinesUnit);
    lineLists_.bind(kLineListsUnit);
    sphereOpen_.bind(kSphereOpenUnit);
    fieldOpen_.bind(kFieldOpenUnit);
    gridOpen_.bind(kGridOpenUnit);
    groundOpen_.bind(kGroundOpenUnit);
    for (int tileClass = 0; tileClass < kClassCount; ++tileClass) {
        const int begin = first[static_cast<std::size_t>(tileClass)];
        const int end = first[static_cast<std::size_t>(tileClass) + 1];
        if (begin == end) continue;
        const GLuint program = programs_.picture(featuresOf(view, sampling, tileClass));
        gl_->UseProgram(program);
        programs_.setInteger(program, "firstTile", begin);
        programs_.setInteger(program, "targetWidth", target.width);
        programs_.setInteger(program, "targetHeight", target.height);
        gl_->DrawArrays(GL_POINTS, 0, end - begin);
    }
}

}  // namespace render
