// Finds the colors of a view's pixels, tile by tile. Used by the Renderer alone.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/draw_times.h"
#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/metaballs/metaball_frame.h"
#include "render/cpu/picture_colors.h"
#include "render/cpu/raster/line_list.h"
#include "render/cpu/shading/background_tiles.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/drawn_spheres.h"
#include "render/prepare/ground_tiles.h"
#include "render/prepare/light_space.h"

namespace render {

/// Which rays are taken through each pixel.
struct Sampling {
    int samples = 1;         ///< 1 or 4
    glm::vec2 offset{0.0F};  ///< from the pixel's middle, pixels; with one sample only
    bool sparse = false;     ///< metaballs are cast sparsely
};

class PicturePass {
 public:
    /// Finds everything that does not depend on where in the pixel the rays go.
    void prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times);

    /// Casts the metaballs' shadows anew where these rays ask for other texels than the last ones.
    void castShadow(const View& view, const Sampling& sampling);

    /// Casts the metaballs for these rays. Does nothing for spheres.
    void castField(const View& view, const Sampling& sampling);

    /// Finds the colors of what these rays see. pixels: row by row, whole tiles of them, as the last picture left
    /// them.
    void color(const View& view, const Sampling& sampling, std::span<PixelColor> pixels);

    /// The same from several samplings of one view without `sparse`: their mean.
    void clearSum();
    void addColors(const View& view, const Sampling& sampling);
    void takeMean(const View& view, int samplings, std::span<PixelColor> pixels);

    /// What the first of these rays through each pixel meets, row by row.
    std::vector<VisiblePoint> visiblePoints(const View& view, const Sampling& sampling);

 private:
    void bin(const View& view);
    void findSkyVisibility(const View& view);
    void findShadows(const View& view);
    void castDepths(const View& view, glm::vec2 shift);
    void findBoxes(const View& view);
    void findGround(const View& view);
    bool castsShadows(const View& view) const;
    Obstruction obstructionOf(const View& view) const;
    template <typename Visit>
    auto withJob(const View& view, const Sampling& sampling, const Visit& visit) const;
    void colorPlain(const View& view, std::span<PixelColor> pixels);

    CameraFrame frame_;
    DrawnSpheres drawn_;
    std::vector<SphereAttributes> sphereAttributes_;
    std::vector<ViewSphere> viewSpheres_;
    std::vector<Rect> spherePixels_;
    CellLists sphereTiles_;
    LineList lineList_;
    std::vector<std::uint8_t> boxTiles_;  // 1 where a box may be seen
    std::vector<GroundTile> groundTiles_;
    PlainTiles plain_;
    LightBasis light_;
    LightGrid lightGrid_;
    int depthMapTexels_ = 1024;
    glm::vec2 depthMapShift_{0.0F};
    DepthMap depthMap_;
    bool needsSkyVisibility_ = false;  // the look asks for openness
    std::vector<SkyVisibility> particleSky_;
    std::vector<SkinBall> skin_;  // of metaballs
    BinnedField binnedField_;     // for the camera
    SkyVisibilityGrid skyGrid_;
    SkyVisibilityMap skyMap_;
    float meanRadius_ = 0.0F;
    FieldPicture field_;
    Shading shading_;
    std::vector<TileClass> classes_;
    std::vector<PointColors> sums_;  // per tile, of several samplings
    bool castsField_ = false;
};

}  // namespace render
