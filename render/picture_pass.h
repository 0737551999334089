// Draws a view tile by tile: finds the colours of what its pixels show, chooses a program for each class of tiles,
// draws. Used by the Renderer alone, with the context current.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/camera_frame.h"
#include "render/depth_map.h"
#include "render/draw_times.h"
#include "render/drawn_spheres.h"
#include "render/gl_objects.h"
#include "render/ground_tiles.h"
#include "render/kept_tiles.h"
#include "render/light_space.h"
#include "render/line_list.h"
#include "render/metaball_frame.h"
#include "render/openness.h"
#include "render/picture_colors.h"
#include "render/program_cache.h"
#include "render/view.h"

namespace render {

/// Mirrors Frame of shaders/frame.glsl, where the fields are explained.
struct FrameBlock {
    glm::vec4 right, up, forward, picture, ground, groundCenter, backgroundTop, backgroundBottom;
};

/// Which rays are taken through each pixel.
struct Sampling {
    int samples = 1;         ///< 1 or 4
    glm::vec2 offset{0.0F};  ///< from the pixel's middle, pixels; with one sample only
    bool sparse = false;     ///< metaballs are cast sparsely
};

class PicturePass {
 public:
    explicit PicturePass(const Gl& gl);

    /// Fills and uploads everything that does not depend on where in the pixel the rays go.
    void prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times);

    /// Casts the metaballs' shadows anew where these rays ask for other texels than the last ones.
    void castShadow(const View& view, const Sampling& sampling);

    /// Casts the metaballs for these rays. Does nothing for spheres.
    void castField(const View& view, const Sampling& sampling);

    /// Finds the colours of what these rays see, but where that is plain; draws nothing yet. pixels: row by row, whole
    /// tiles of them.
    void color(const View& view, const Sampling& sampling, std::span<PixelColor> pixels);

    /// The same from several samplings without `sparse`: their mean.
    void clearSum();
    void addColors(const View& view, const Sampling& sampling);
    void takeMean(int samplings, std::span<PixelColor> pixels);

    /// What the first of these rays through each pixel meets, row by row.
    std::vector<SurfacePoint> surfaces(const View& view, const Sampling& sampling);

    /// Draws the picture to the bound target, whose size is a whole number of tiles: the pixels that were found, and
    /// what they leave out. Those of other tiles must be those of the last picture.
    void draw(const View& view, PictureSize target, const PixelTexture& pixels);

    ProgramCache& programs() { return programs_; }

 private:
    void bin(const View& view);
    void findOpenness(const View& view);
    void binShadows(const View& view);
    void castDepths(const View& view, glm::vec2 shift);
    void findBoxes(const View& view);
    void findGround(const View& view);
    bool castsShadows(const View& view) const;
    Obstruction obstructionOf(const View& view) const;
    template <typename Visit>
    auto withJob(const View& view, const Sampling& sampling, const Visit& visit) const;
    FrameBlock uploadFrame(const View& view);
    std::vector<TileClass> classesToDraw(const FrameBlock& block);

    const Gl* gl_;
    ProgramCache programs_;
    TextureBuffer tileTable_;
    BufferName frameBlock_;

    CameraFrame frame_;
    DrawnSpheres drawn_;
    std::vector<SphereLook> looks_;
    std::vector<ViewSphere> viewSpheres_;
    std::vector<Rect> spherePixels_;
    CellLists sphereTiles_;
    LineList lineList_;
    std::vector<std::uint8_t> boxTiles_;  // 1 where a box may be seen
    std::vector<GroundTile> groundTiles_;
    KeptTiles kept_;
    LightBasis light_;
    LightGrid lightGrid_;
    int depthMapTexels_ = 1024;
    glm::vec2 depthMapShift_{0.0F};
    DepthMap depthMap_;
    bool opens_ = false;  // the look asks for openness
    std::vector<Openness> particleOpen_;
    std::vector<SkinBall> skin_;  // of metaballs
    BinnedField binnedField_;     // for the camera
    OpennessGrid openGrid_;
    OpennessMap openMap_;
    float meanRadius_ = 0.0F;
    FieldPicture field_;
    Shading shading_;
    std::vector<TileClass> classes_;
    std::vector<PointColors> sums_;  // per tile, of several samplings
    bool castsField_ = false;
};

}  // namespace render
