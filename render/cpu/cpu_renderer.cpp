// The stages of a picture and what each hands to the next.
#include "render/cpu/cpu_renderer.h"

#include <optional>
#include <utility>

#include <tbb/parallel_invoke.h>

#include "render/cpu/lighting/mesh_depth_map.h"
#include "render/cpu/metaballs/metaball_frame.h"
#include "render/cpu/surface_layers.h"
#include "render/picture/pixel_samples.h"

namespace render {

namespace {

/// The samples of a pixel, one pass over the picture for each element. In final quality a regular grid of samples, each
/// clamped, whose mean is taken in linear light.
std::vector<Sampling> samplingsOf(Quality quality, const SampleRange& samples) {
    if (quality == Quality::draft) return {{.isSparse = true}};
    if (quality == Quality::normal) return {{.samples = 4, .isSparse = true}};
    std::vector<Sampling> samplings;
    for (int index = samples.begin; index < samples.end; ++index)
        samplings.push_back({.offset = pixelSample(index, samples.perAxis).offset,
                             .index = static_cast<std::size_t>(index),
                             .count = static_cast<std::size_t>(samples.count()),
                             .isOfOneView = samples.isOnly});
    return samplings;
}

/// Rays through the middles of the pixels alone, which hit what the rays of a picture hit there.
Sampling middlesOf(Quality quality) {
    return {.isSparse = quality != Quality::final};
}

std::size_t pixelCount(PictureSize size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

}  // namespace

CpuRenderer::CpuRenderer(PictureSize size, Quality quality)
    : size_(size),
      padded_{kTileSize * tilesAlong(size.width), kTileSize * tilesAlong(size.height)},
      quality_(quality),
      pixels_(pixelCount(padded_)) {}

void CpuRenderer::draw(const PreparedView& view, const SampleRange& samples, const LayerSelection& wanted,
                       Layers& layers, DrawTimes& times) {
    shading_ = shadingOf(*view.view);
    blackShading_ = shading_;
    blackShading_.background = {};
    placeMeshes(view, times);
    // What the middles of the pixels show needs no other rays.
    const std::vector<Sampling> samplings =
        wanted.isShaded() ? samplingsOf(quality_, samples) : std::vector{middlesOf(quality_)};
    for (const Sampling& sampling : samplings) {
        cast(view, sampling, times);
        timed(times.color, [&] { drawLayers(view, sampling, wanted, layers); });
    }
    if (!wanted.image || samplings.back().index + 1 < samplings.back().count) return;
    timed(times.readBack, [&] { layers.image = packedImage(size_, pixels_, padded_.width, std::move(layers.image)); });
}

// The same for all samplings: the filter of the depth map is smooth, and its map is as fine as the picture. Tiles and
// map are made side by side, because each has parts that keep only one thread busy. Those of the last picture are kept
// while the camera, the light and all meshes are at rest.
void CpuRenderer::placeMeshes(const PreparedView& view, DrawTimes& times) {
    PlacedMeshes placed{view.meshes.obstacles, view.frame, view.lineMargin(), view.light, view.meshDepthMap};
    if (placed == placedMeshes_) {
        if (!view.meshes.empty()) meshTiles_.meshes = &view.meshes;  // equal ones, maybe in another place
        return;
    }
    placedMeshes_.reset();
    const auto bin = [&] { meshTiles_ = meshTiles(view.frame, view.meshes, view.lineMargin(), std::move(meshTiles_)); };
    const auto drawMap = [&] {
        const DepthMapGrid& grid = view.meshDepthMap;
        meshDepthMap_ =
            grid.empty() ? DepthMap{} : meshDepthMap(view.light, grid, view.meshes, std::move(meshDepthMap_));
    };
    tbb::parallel_invoke([&] { timed(times.bin, bin); }, [&] { timed(times.shadow, drawMap); });
    placedMeshes_ = std::move(placed);
}

void CpuRenderer::drawLayers(const PreparedView& view, const Sampling& sampling, const LayerSelection& wanted,
                             Layers& layers) {
    const PictureJob job = pictureJob(view, sampling, shading_);
    if (wanted.image)
        colorPixels(job, {sampling.index, sampling.count, sampling.isOfOneView, sums_}, background_, pixels_);
    if (wanted.color)
        colorLayer(pictureJob(view, sampling, blackShading_), sampling.index, sampling.count, layers.color);
    const bool isOfMiddles = sampling.offset == glm::vec2(0.0F);
    if (isOfMiddles && (wanted.points || wanted.ids)) findSurfaceLayers(job, view, wanted, layers);
}

// In final quality the rays of a sampling are moved by a part of a pixel. The texels of the depth map are moved by the
// same part of a texel with them, so that the mean of the samplings shows the mean of as many depth maps.
void CpuRenderer::castDepthMap(const PreparedView& view, glm::vec2 offset) {
    if (view.depthMap.empty()) {
        depthMap_ = {};
        return;
    }
    if (offset == glm::vec2(0.0F)) {
        depthMap_ = render::castDepthMap(view.depthMap, view.lightMetaballs);
        return;
    }
    const DepthMapGrid grid = view.depthMap.shifted(offset);
    depthMap_ = render::castDepthMap(
        grid, metaballScene(lightFrame(view.light, grid, view.frame.eye, 1), *view.view, view.skin));
}

void CpuRenderer::cast(const PreparedView& view, const Sampling& sampling, DrawTimes& times) {
    timed(times.shadow, [&] { castDepthMap(view, sampling.offset); });
    if (!view.hasMetaballs) return;
    timed(times.cast, [&] {
        castMetaballs(view.metaballs, {sampling.offset, sampling.samples > 1, sampling.isSparse}, metaballHits_);
    });
}

Occluders CpuRenderer::occludersOf(const PreparedView& view) const {
    Occluders occluders;
    occluders.light = view.light;
    occluders.eye = view.frame.eye;
    if (!view.lightGrid.empty()) occluders.spheres = &view.lightGrid;
    if (!depthMap_.empty()) occluders.metaballs = &depthMap_;
    if (!view.opticalDepth.empty()) occluders.opticalDepth = &view.opticalDepth;
    if (view.hasMetaballs) occluders.transparency = view.view->surface.medium.transparency;
    if (!meshDepthMap_.empty()) occluders.meshes = &meshDepthMap_;
    if (!view.shadowBoxes.boxes.empty()) occluders.lightBoxes = &view.lightBoxes;
    occluders.boxes = view.shadowBoxes.boxes;
    occluders.subtractedBoxCount = view.shadowBoxes.subtractedCount;
    occluders.softness = view.view->light.softness;
    occluders.meanRadius = view.meanRadius;
    if (!view.glowGrid.empty()) occluders.glow = &view.glowGrid;
    if (view.hasOcclusion()) {
        occluders.sky = &view.skyGrid;
        occluders.groundSky = &view.groundSky;
    }
    return occluders;
}

/// The job points into the prepared view, the sampling and this object, which have to outlive it.
PictureJob CpuRenderer::pictureJob(const PreparedView& view, const Sampling& sampling, const Shading& shading) const {
    const std::vector<BoxObstacle>& boxes = view.view->boxObstacles;
    const SolidGeometry solids{view.frame,
                               view.viewSpheres,
                               view.spherePixels,
                               &view.sphereTiles,
                               boxes,
                               view.boxFronts,
                               &view.boxTiles,
                               view.groundHeight(),
                               view.meshes.empty() ? nullptr : &meshTiles_};
    const ShadingGeometry geometry{view.frame,
                                   view.drawn.spheres,
                                   view.sphereAttributes,
                                   view.drawn.firstObstacle,
                                   boxes,
                                   solids.ground,
                                   view.view->ground.value_or(Ground{}).color,
                                   metaballHits_.hits,
                                   view.light.toLight,
                                   view.needsSkyVisibility,
                                   &view.meshes};
    const Occluders occluders = occludersOf(view);
    return {{solids, view.hasMetaballs ? &metaballHits_ : nullptr, view.lines, view.groundTiles},
            sampling.samples == 1 ? SampleOffsets(&sampling.offset, 1) : kFourSamples,
            geometry,
            occluders.isEmpty() ? std::nullopt : std::optional(occluders),
            shading,
            view.hasTransparency ? &view : nullptr};
}

}  // namespace render
