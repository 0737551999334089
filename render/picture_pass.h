// Draws a view tile by tile: fills the lists that the shaders walk, chooses a program for each class of tiles, draws.
// Used by the Renderer alone, with the context current.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/camera_frame.h"
#include "render/draw_times.h"
#include "render/gl_objects.h"
#include "render/ground_tiles.h"
#include "render/kept_tiles.h"
#include "render/light_space.h"
#include "render/line_list.h"
#include "render/metaball_frame.h"
#include "render/openness.h"
#include "render/program_cache.h"
#include "render/view.h"

namespace render {

/// Mirrors FrameBlock of shaders/frame.glsl, where the fields are explained.
struct FrameBlock {
    glm::vec4 right, up, forward, picture, toLight, lightColor, ambientSky, ambientGround, groundColor, groundCenter;
    glm::vec4 backgroundTop, backgroundBottom, lightU, lightV, lightGrid;
    glm::ivec4 lightCells;
    glm::vec4 depthMap;
    glm::ivec4 counts;
    glm::vec4 material, tone, mirrorTop, mirrorHorizon, mirrorBottom, openGrid;
    glm::ivec4 openCells;
    glm::vec4 openMap, soft;
};

/// Which rays one drawing takes through a pixel, and what becomes of their colours.
struct Sampling {
    int samples = 1;         ///< 1 or 4
    glm::vec2 offset{0.0F};  ///< from the pixel's middle, pixels; with one sample only
    Output output = Output::bytes;
    bool keeps = false;  ///< the target still holds the last picture that was drawn with `keeps`
};

/// Spheres that OpenGL draws: obstacles always, particles unless they are metaballs.
struct DrawnSpheres {
    std::vector<ViewSphere> spheres;  ///< center relative to the eye, in world axes
    std::vector<glm::vec4> colors;    ///< w: 1 for particles, 0 for obstacles
    std::vector<glm::vec4> open;      ///< two a sphere: openness along +x, +y, +z and along -x, -y, -z; empty without
};

class PicturePass {
 public:
    explicit PicturePass(const Gl& gl);

    /// Fills and uploads everything that does not depend on where in the pixel the rays go.
    void prepare(const CameraFrame& frame, const View& view, int depthMapTexels, DrawTimes& times);

    /// Casts the metaballs' shadows anew where these rays ask for other texels than the last ones.
    void castShadow(const View& view, const Sampling& sampling);

    /// Casts the metaballs for these rays; draws nothing yet. Does nothing for spheres.
    void castField(const View& view, const Sampling& sampling);

    /// Draws to the bound target, whose size is a whole number of tiles.
    void draw(const View& view, const Sampling& sampling, PictureSize target);

    ProgramCache& programs() { return programs_; }

 private:
    void binSpheres(const View& view);
    void findOpenness(const View& view);
    void castLight(const View& view);
    void castDepths(const View& view, glm::vec2 shift);
    void uploadLines(const View& view);
    void uploadBoxes(const View& view);
    void sortGround(const View& view);
    FrameBlock uploadFrame(const View& view, const Sampling& sampling);
    Features featuresOf(const View& view, const Sampling& sampling, int tileClass) const;
    int classOf(std::size_t tile) const;
    std::vector<int> classesOfTiles(const FrameBlock& block, const Sampling& sampling);
    std::vector<int> uploadTileTable(const std::vector<int>& classes);

    const Gl* gl_;
    ProgramCache programs_;
    TextureBuffer boxes_, tileTable_, tileSpheres_, tileSphereIds_, sphereColors_, fieldSamples_;
    TextureBuffer lightLists_, lightSpheres_, lightDepths_, lines_, lineLists_;
    TextureBuffer sphereOpen_, fieldOpen_, gridOpen_, groundOpen_;
    BufferName frameBlock_;

    CameraFrame frame_;
    DrawnSpheres drawn_;
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
    OpennessGrid openGrid_;
    OpennessMap openMap_;
    float meanRadius_ = 0.0F;
    std::vector<std::int32_t> fieldSlots_;
    std::vector<float> fieldFarthest_;
    bool castsField_ = false;
};

}  // namespace render
