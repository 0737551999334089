// Finds the colors of a view's pixels: prepares what the tiles show, casts the metaballs and colors tile by tile. Used
// by the Renderer alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/draw_times.h"
#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/metaballs/metaball_frame.h"
#include "render/cpu/metaballs/metaball_scene.h"
#include "render/cpu/picture_colors.h"
#include "render/cpu/raster/lines.h"
#include "render/cpu/shading/ground_tiles.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/drawn_spheres.h"
#include "render/prepare/light_space.h"

namespace render {

/// Which rays are taken through each pixel: one of `count` samplings whose mean is the picture.
struct Sampling {
    int samples = 1;         ///< samples per pixel, 1 or 4
    glm::vec2 offset{0.0F};  ///< offset of a single sample from the pixel's middle, pixels
    bool isSparse = false;   ///< whether smooth metaballs are cast at every second pixel only and interpolated between
    std::size_t index = 0;   ///< number of earlier samplings of the same picture
    std::size_t count = 1;   ///< number of samplings
};

class PicturePass {
 public:
    /// Prepares everything that does not depend on the sampling.
    /// @param depthMapTexels  number of texels along the longer side of the depth map
    void prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times);

    /// Casts the depth map of the metaballs again if this sampling shifts its texels in another way than the last one.
    void castShadow(const View& view, const Sampling& sampling);

    /// Casts the metaballs for the camera. Does nothing for spheres.
    void castMetaballs(const Sampling& sampling);

    /// Colors the picture. Of several samplings, whose mean is the picture, the last one writes the pixels.
    /// @param pixels  pixels of all tiles, row by row, as the last call left them
    void color(const View& view, const Sampling& sampling, std::span<PixelColor> pixels);

    /// The surface point that the first sample of each pixel hits, row by row.
    std::vector<VisiblePoint> visiblePoints(const View& view, const Sampling& sampling) const;

 private:
    void bin(const View& view);
    void findSkyVisibility(const View& view);
    void findShadowCasters(const View& view);
    void castDepthMap(const View& view, glm::vec2 shift);
    void findBoxTiles(const View& view);
    void findGroundTiles(const View& view);
    Occluders occludersOf(const View& view) const;
    PictureJob pictureJob(const View& view, const Sampling& sampling) const;

    CameraFrame frame_;
    Shading shading_;
    float meanRadius_ = 0.0F;  // mean radius of the particles, m
    // Spheres:
    DrawnSpheres drawn_;
    std::vector<SphereAttributes> sphereAttributes_;
    std::vector<ViewSphere> viewSpheres_;
    std::vector<Rect> spherePixels_;
    CellLists sphereTiles_;
    // Metaballs:
    bool hasMetaballs_ = false;
    std::vector<SkinBall> skin_;
    MetaballScene metaballScene_;
    MetaballHits metaballHits_;
    // Lines, boxes and the ground:
    LineList lineList_;
    std::vector<std::uint8_t> boxTiles_;  // per tile: 1 where a box may be seen
    std::vector<TileKind> groundTiles_;
    // Light and sky:
    LightBasis light_;
    LightGrid lightGrid_;
    int depthMapTexels_ = 1024;
    glm::vec2 depthMapShift_{0.0F};
    DepthMap depthMap_;
    bool needsSkyVisibility_ = false;
    SkyVisibilityGrid skyGrid_;
    SkyVisibilityMap groundSky_;
    std::vector<SkyVisibility> particleSky_;

    BackgroundCache background_;
    std::vector<PointColors> sums_;  // per tile: sums of the colors of all samplings so far
};

}  // namespace render
