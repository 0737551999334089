// The renderer on the CPU's vector units, which gives the same bits on every machine. Its stages: cast the metaballs,
// find what the samples of each pixel hit, color it. In final quality metaballs are cast and pixels colored nine times
// or more, with the rays moved within the pixel.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/metaballs/metaball_hits.h"
#include "render/cpu/picture_colors.h"
#include "render/cpu/raster/mesh_tiles.h"
#include "render/cpu/shading/shade.h"
#include "render/prepare/view_renderer.h"

namespace render {

/// Which rays are taken through each pixel: one of `count` samplings whose mean is the picture.
struct Sampling {
    int samples = 1;          ///< samples per pixel, 1 or 4
    glm::vec2 offset{0.0F};   ///< offset of a single sample from the pixel's middle, pixels
    bool isSparse = false;    ///< whether smooth metaballs are cast at every second pixel only and interpolated between
    std::size_t index = 0;    ///< number of earlier samplings of the same picture
    std::size_t count = 1;    ///< number of samplings
    bool isOfOneView = true;  ///< whether all samplings of the picture show the same view
};

/// What the tiles and the depth map of meshes depend on.
struct PlacedMeshes {
    std::vector<MeshObstacle> obstacles;
    CameraFrame frame;
    int lineMargin = 0;
    LightBasis light;
    DepthMapGrid depthMap;

    bool operator==(const PlacedMeshes&) const = default;
};

class CpuRenderer final : public ViewRenderer {
 public:
    CpuRenderer(PictureSize size, Quality quality);

    void draw(const PreparedView& view, const SampleRange& samples, const LayerSelection& wanted, Layers& layers,
              DrawTimes& times) override;

 private:
    void drawLayers(const PreparedView& view, const Sampling& sampling, const LayerSelection& wanted, Layers& layers);
    void placeMeshes(const PreparedView& view, DrawTimes& times);
    void castDepthMap(const PreparedView& view, glm::vec2 offset);
    void cast(const PreparedView& view, const Sampling& sampling, DrawTimes& times);
    PictureJob pictureJob(const PreparedView& view, const Sampling& sampling, const Shading& shading) const;
    Occluders occludersOf(const PreparedView& view) const;

    PictureSize size_;
    PictureSize padded_;  // size of whole tiles
    Quality quality_;
    Shading shading_;
    Shading blackShading_;  // without background, for Layers::color
    MetaballHits metaballHits_;
    DepthMap depthMap_;
    DepthMap meshDepthMap_;
    MeshTiles meshTiles_;
    std::optional<PlacedMeshes> placedMeshes_;  // what the depth map and the tiles of meshes show
    BackgroundCache background_;
    std::vector<PointColors> sums_;   // per tile: sums of the colors of all samplings so far
    std::vector<PixelColor> pixels_;  // pixels of whole tiles, row by row
};

}  // namespace render
