// Numbers of the view that all pixels share, in the order of the block.
#include "render/opengl/frame_uniforms.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// The normalization (g + 8) / 8 of the highlight in shading_model.h.
float highlightNorm(int glossExponent) {
    return (static_cast<float>(1 << glossExponent) + 8.0F) / 8.0F;
}

void setCamera(const PreparedView& view, FrameUniforms& to) {
    const CameraFrame& frame = view.frame;
    to.image = {2.0F / static_cast<float>(frame.width), 2.0F / static_cast<float>(frame.height), frame.halfWidth,
                frame.halfHeight};
    to.right = {frame.right, frame.pixelWidth()};
    to.up = {frame.up, 1.0F / static_cast<float>(frame.height)};
    to.forward = {frame.forward, view.groundHeight().value_or(0.0F)};
}

void setLook(const View& view, FrameUniforms& to) {
    const Surface& surface = view.surface;
    to.lightColor = {view.light.color, view.exposure};
    to.sky = {view.ambient.sky, view.ambient.occlusion};
    to.skyBelow = {view.ambient.ground, view.camera.shift.x};
    to.surface = {surface.specular, surface.reflection, surface.metal, surface.roughness};
    to.body = {surface.translucency, surface.absorption, surface.glow, highlightNorm(surface.glossExponent)};
    to.surroundingsTop = {view.surroundings.top, view.light.rim.r};
    to.surroundingsHorizon = {view.surroundings.horizon, view.light.rim.g};
    to.surroundingsBottom = {view.surroundings.bottom, view.light.rim.b};
    to.backgroundTop = {view.background.top, 0.0F};
    to.backgroundBottom = {view.background.bottom, 0.0F};
    const Ground ground = view.ground.value_or(Ground{});
    to.groundColor = {ground.color, 0.0F};
    to.groundCenter = {ground.center - view.camera.eye, 1.0F / ground.fadeDistance};
}

void setMetaballs(const PreparedView& view, glm::vec2 offset, FrameUniforms& to) {
    const DepthMapGrid grid = view.depthMap.shifted(offset);
    to.depthMapGrid = {grid.origin, grid.texelSize, grid.top};
    to.depthMapSize = {glm::vec2(grid.columns, grid.rows), 1.0F / std::max(grid.top - grid.bottom, 1e-30F), 0.0F};
    const MetaballScene& balls = view.metaballs;
    for (const Metaball& ball : balls.balls) to.depthMapSize.w = std::max(to.depthMapSize.w, ball.reach);
    const SmoothnessLimits limits = smoothnessLimits(balls);
    // Chosen: where the parabola through three samples comes as near to the threshold as this, the field is sampled
    // more densely.
    const float nearly = 0.02F * balls.threshold;
    to.metaballs = {balls.threshold, balls.step, balls.smallestRadius, nearly};
    // Three times the CPU's limit: a ray costs more here, and pictures are no less exact (`globular study pictures`).
    to.sampleOffset = {offset, 3.0F * limits.depth, limits.maxField};
}

}  // namespace

FrameUniforms frameUniforms(const PreparedView& prepared, glm::vec2 offset) {
    FrameUniforms to{};
    const View& view = *prepared.view;
    setCamera(prepared, to);
    setLook(view, to);
    to.toLight = {prepared.light.toLight, view.light.softness};
    to.lightU = {prepared.light.u, prepared.meanRadius};
    to.lightV = {prepared.light.v, view.camera.shift.y};
    const LightGrid& casters = prepared.lightGrid;
    to.lightCells = {casters.origin, 1.0F / casters.cellSize, 0.0F};
    const LightBoxGrid& boxes = prepared.lightBoxes;
    to.boxCells = {boxes.origin, 1.0F / boxes.cellSize, boxes.widestPixel};
    to.lightCellCount = glm::vec4(casters.columns, casters.rows, boxes.columns, boxes.rows);
    const SkyVisibilityGrid& sky = prepared.skyGrid;
    to.skyCells = {sky.origin - prepared.frame.eye, 1.0F / sky.side};
    to.skyCellCount = glm::vec4(sky.cells, 0);
    const GlowGrid& glow = prepared.glowGrid;
    to.glowCells = {glow.origin - prepared.frame.eye, 1.0F / glow.side};
    to.glowCellCount = glm::vec4(glow.cells, 0);
    to.sampleOffset = {offset, 0.0F, 0.0F};
    if (prepared.hasMetaballs) setMetaballs(prepared, offset, to);
    to.counts =
        glm::vec4(prepared.drawn.firstObstacle, view.surface.glossExponent, prepared.shadowBoxes.boxes.size(), 0.0F);
    return to;
}

}  // namespace render
