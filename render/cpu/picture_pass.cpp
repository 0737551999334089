// The stages of a picture and what each hands to the next. Positions are relative to the eye.
#include "render/cpu/picture_pass.h"

#include <optional>
#include <utility>

#include <tbb/parallel_invoke.h>

namespace render {

namespace {

bool needsSkyVisibility(const View& view) {
    const Surface& surface = view.surface;
    return !view.particles.empty() && (view.ambient.occlusion > 0.0F || surface.reflection > 0.0F ||
                                       surface.translucency > 0.0F || surface.absorption > 0.0F);
}

}  // namespace

void PicturePass::prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times) {
    frame_ = frame;
    light_ = lightBasis(view.light.toLight);
    shading_ = shadingOf(view);
    hasMetaballs_ = view.style == Style::metaballs && !view.particles.empty();
    meanRadius_ = static_cast<float>(meanRadius(view.particles));
    depthMapTexels_ = depthMapTexels;
    // Sky visibility, tiles and shadow casters are found side by side: none needs the others' results, and each has
    // parts that keep only one thread busy.
    const auto placeBalls = [&] {
        timed(times.bin, [&] {
            drawn_ = drawnSpheres(view);
            skin_ = hasMetaballs_ ? skinOf(view) : std::vector<SkinBall>{};
        });
        tbb::parallel_invoke([&] { timed(times.bin, [&] { bin(view); }); },
                             [&] { timed(times.shadow, [&] { findShadowCasters(view); }); });
    };
    tbb::parallel_invoke([&] { timed(times.occlusion, [&] { findSkyVisibility(view); }); }, placeBalls);
    timed(times.bin, [&] {
        sphereAttributes_ = sphereAttributes(view, drawn_, particleSky_);
        if (hasMetaballs_) setAttributes(view, particleSky_, metaballScene_);
        findBoxTiles(view);
        findGroundTiles(view);
    });
}

void PicturePass::findSkyVisibility(const View& view) {
    needsSkyVisibility_ = needsSkyVisibility(view);
    skyGrid_ = needsSkyVisibility_ ? skyVisibilityGrid(view.particles, std::move(skyGrid_)) : SkyVisibilityGrid{};
    particleSky_ = needsSkyVisibility_ ? particleSkyVisibility(view.particles, skyGrid_) : std::vector<SkyVisibility>{};
    groundSky_ =
        needsSkyVisibility_ && view.ground ? skyVisibilityAtHeight(skyGrid_, view.ground->height) : SkyVisibilityMap{};
}

void PicturePass::bin(const View& view) {
    viewSpheres_.resize(drawn_.spheres.size());
    for (std::size_t k = 0; k < viewSpheres_.size(); ++k)
        viewSpheres_[k] = {frame_.toView(drawn_.spheres[k].center + frame_.eye), drawn_.spheres[k].radius};
    spherePixels_ = pixelBounds(frame_, viewSpheres_);
    sphereTiles_ = binToTiles(frame_, viewSpheres_, spherePixels_);
    lineList_ = projectEdges(frame_, view.edges);
    if (hasMetaballs_) metaballScene_ = metaballScene(frame_, view, skin_);
}

void PicturePass::findShadowCasters(const View& view) {
    lightGrid_ = view.light.shadows ? lightGrid(light_, drawn_.spheres, view.light.softness) : LightGrid{};
    castDepthMap(view, glm::vec2(0.0F));
}

void PicturePass::castDepthMap(const View& view, glm::vec2 shift) {
    depthMapShift_ = shift;
    depthMap_ = hasMetaballs_ && view.light.shadows
                    ? render::castDepthMap(light_, view, skin_, {depthMapTexels_, shift})
                    : DepthMap{};
}

// In final quality the rays of a sampling are moved by a third of a pixel. The texels of the depth map are moved by a
// third of a texel with them, so that the mean of the samplings shows the mean of nine depth maps.
void PicturePass::castShadow(const View& view, const Sampling& sampling) {
    if (!depthMap_.empty() && sampling.offset != depthMapShift_) castDepthMap(view, sampling.offset);
}

void PicturePass::findBoxTiles(const View& view) {
    boxTiles_.assign(sphereTiles_.cellCount(), 0);
    for (const BoxObstacle& box : view.boxObstacles) {
        const auto pixels = pixelsTouchedByBox(frame_, box.minimum, box.maximum);
        if (!pixels) continue;
        for (int row = pixels->y0 / kTileSize; row <= pixels->y1 / kTileSize; ++row)
            for (int column = pixels->x0 / kTileSize; column <= pixels->x1 / kTileSize; ++column)
                boxTiles_[sphereTiles_.cellIndex(column, row)] = 1;
    }
}

void PicturePass::findGroundTiles(const View& view) {
    groundTiles_.assign(sphereTiles_.cellCount(), TileKind::background);
    if (view.ground) groundTiles_ = groundTiles(frame_, view.ground->height - frame_.eye.y, occludersOf(view));
}

void PicturePass::castMetaballs(const Sampling& sampling) {
    if (!hasMetaballs_) return;
    render::castMetaballs(metaballScene_, {sampling.offset, sampling.samples > 1, sampling.isSparse}, metaballHits_);
}

Occluders PicturePass::occludersOf(const View& view) const {
    Occluders occluders;
    occluders.light = light_;
    occluders.eye = frame_.eye;
    if (!lightGrid_.empty()) occluders.spheres = &lightGrid_;
    if (!depthMap_.empty()) occluders.metaballs = &depthMap_;
    if (view.light.shadows) occluders.boxes = view.boxObstacles;
    occluders.softness = view.light.softness;
    occluders.meanRadius = meanRadius_;
    if (needsSkyVisibility_ && view.ambient.occlusion > 0.0F) {
        occluders.sky = &skyGrid_;
        occluders.groundSky = &groundSky_;
    }
    return occluders;
}

/// The job points into the view, the sampling and this object, which have to outlive it.
PictureJob PicturePass::pictureJob(const View& view, const Sampling& sampling) const {
    SolidGeometry solids{frame_, viewSpheres_, spherePixels_, &sphereTiles_, view.boxObstacles, std::nullopt};
    if (view.ground) solids.ground = view.ground->height - frame_.eye.y;
    const ShadingGeometry geometry{frame_,
                                   drawn_.spheres,
                                   sphereAttributes_,
                                   drawn_.firstObstacle,
                                   view.boxObstacles,
                                   solids.ground,
                                   view.ground.value_or(Ground{}).color,
                                   metaballHits_.hits,
                                   light_.toLight,
                                   needsSkyVisibility_};
    const Occluders occluders = occludersOf(view);
    return {{solids, hasMetaballs_ ? &metaballHits_ : nullptr, lineList_, boxTiles_, groundTiles_},
            sampling.samples == 1 ? SampleOffsets(&sampling.offset, 1) : kFourSamples,
            geometry,
            occluders.isEmpty() ? std::nullopt : std::optional(occluders),
            shading_};
}

void PicturePass::color(const View& view, const Sampling& sampling, std::span<PixelColor> pixels) {
    colorPixels(pictureJob(view, sampling), {sampling.index, sampling.count, sums_}, background_, pixels);
}

std::vector<VisiblePoint> PicturePass::visiblePoints(const View& view, const Sampling& sampling) const {
    return render::visiblePoints(pictureJob(view, sampling));
}

}  // namespace render
