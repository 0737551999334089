// The tables behind shaders/picture.frag and the draws over them. Positions are handed to OpenGL relative to the eye.
#include "render/picture_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <tbb/parallel_for.h>

namespace render {

namespace {

// A tile's class: which of these it shows. Tiles of one class are drawn together with a program that has only that.
enum ClassBit { kSphereBit = 1, kFieldBit = 2, kLineBit = 4, kBoxBit = 8, kClassCount = 16 };

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

DrawnSpheres drawnSpheres(const View& view) {
    DrawnSpheres drawn;
    const auto add = [&](glm::vec3 center, float radius, glm::vec3 color, float specular) {
        if (!(radius > 0.0F)) return;
        drawn.spheres.push_back({center - view.camera.eye, radius});
        drawn.colors.emplace_back(color, specular);
    };
    if (view.style == Style::spheres) {
        for (const Sphere& s : view.particles) add(s.center, s.radius, s.color, view.surface.specular);
    }
    for (const SphereObstacle& s : view.sphereObstacles) add(s.center, s.radius, s.color, 0.0F);
    return drawn;
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
      lineLists_(gl, "lines in tiles", GL_R32I, 4) {
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
    binSpheres(view);
    uploadLines(view);
    uploadBoxes(view);
    clock.add(times.bin);
    castLight(view, depthMapTexels);
    clock.add(times.shadow);
}

void PicturePass::binSpheres(const View& view) {
    drawn_ = drawnSpheres(view);
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
}

void PicturePass::castLight(const View& view, int depthMapTexels) {
    lightGrid_ = view.light.shadows ? lightGrid(light_, drawn_.spheres) : LightGrid{};
    lightLists_.upload(bytesOf(lightGrid_.cells));
    lightSpheres_.upload(bytesOf(lightGrid_.spheres));
    depthMap_ = castsField_ && view.light.shadows ? castDepthMap(light_, view, depthMapTexels) : DepthMap{};
    lightDepths_.upload(bytesOf(depthMap_.heights));
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

void PicturePass::castField(const View& view, const Sampling& sampling) {
    if (!castsField_) return;
    const FieldPicture picture = castPicture(frame_, view, {sampling.offset, sampling.samples > 1});
    fieldSlots_ = picture.slots;
    fieldSamples_.upload(bytesOf(picture.samples));
}

void PicturePass::uploadFrame(const View& view, const Sampling& sampling) {
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
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.get());
    gl_->BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
}

Features PicturePass::featuresOf(const View& view, const Sampling& sampling, int tileClass) const {
    Features features;
    features.samples = sampling.samples;
    features.output = sampling.output;
    features.spheres = (tileClass & kSphereBit) != 0;
    features.field = (tileClass & kFieldBit) != 0;
    features.lines = (tileClass & kLineBit) != 0;
    features.boxes = (tileClass & kBoxBit) != 0;
    features.ground = view.ground.has_value();
    features.lightSpheres = !lightGrid_.spheres.empty();
    features.lightField = depthMap_.heights.size() > 1;
    features.lightBoxes = view.light.shadows && !view.boxObstacles.empty();
    features.shadows = features.lightSpheres || features.lightField || features.lightBoxes;
    features.specular =
        view.surface.specular > 0.0F && (features.field || (features.spheres && view.style == Style::spheres));
    return features;
}

int PicturePass::classOf(std::size_t tile) const {
    int bits = 0;
    if (sphereTiles_.begin[tile + 1] > sphereTiles_.begin[tile]) bits |= kSphereBit;
    if (!fieldSlots_.empty() && fieldSlots_[tile] >= 0) bits |= kFieldBit;
    if (lineList_.tiles.begin[tile + 1] > lineList_.tiles.begin[tile]) bits |= kLineBit;
    if (boxTiles_[tile] != 0) bits |= kBoxBit;
    return bits;
}

// Rows of the table class by class; returns how many rows come before each class, and the number of all.
std::vector<int> PicturePass::uploadTileTable() {
    const std::size_t tileCount = sphereTiles_.begin.size() - 1;
    std::vector<int> first(kClassCount + 1, 0);
    for (std::size_t tile = 0; tile < tileCount; ++tile) ++first[static_cast<std::size_t>(classOf(tile)) + 1];
    for (std::size_t c = 0; c < kClassCount; ++c) first[c + 1] += first[c];
    std::vector<TileRow> rows(tileCount);
    std::vector<int> next = first;
    for (std::size_t tile = 0; tile < tileCount; ++tile) {
        const auto columns = static_cast<std::size_t>(sphereTiles_.columns);
        rows[static_cast<std::size_t>(next[static_cast<std::size_t>(classOf(tile))]++)] = {
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
    uploadFrame(view, sampling);
    const std::vector<int> first = uploadTileTable();
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
