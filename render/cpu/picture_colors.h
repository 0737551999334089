// The colors of a picture's pixels, and the surface points that they show, tile by tile. Called by the picture pass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/shading/shade.h"
#include "render/cpu/tile_samples.h"
#include "render/picture/image.h"

namespace render {

/// Everything that the pixels of one picture are colored from.
struct PictureJob {
    TileContents contents;
    SampleOffsets offsets;
    ShadingGeometry geometry;
    std::optional<Occluders> occluders;  ///< nothing where nothing casts shadows or occludes the sky
    const Shading& shading;
};

/// A picture that is the mean of several, which are colored one after another.
struct PictureMean {
    std::size_t index = 0;  ///< of this picture
    std::size_t count = 1;
    std::vector<PointColors>& sums;  ///< of the pictures so far, a tile each; not used for one picture
};

/// Knows which tiles of the pixels show nothing but background or open ground. They stay as they are in the next
/// picture while the camera, the background and the ground do not change: in a film whose camera rests a twentieth of
/// the time to draw a frame is saved (measured by perf on `globular bench --filter "draw frame solid"`).
class BackgroundCache {
 public:
    /// Starts a picture, and forgets all tiles if anything is new that their colors are computed from.
    void begin(const ShadingGeometry& geometry, const Shading& shading, std::size_t tileCount);

    /// Notes what a tile shows in this picture. @return whether its pixels show that already
    bool keeps(std::size_t tile, TileKind kind);

 private:
    struct Key {
        CameraFrame frame;
        std::optional<float> ground;
        Background background;
        glm::vec3 openGround{0.0F};
        glm::vec3 groundCenter{0.0F};
        float fadeDistance = 1.0F;

        bool operator==(const Key&) const = default;
    };
    Key key_;
    std::vector<TileKind> kinds_;
};

/// Colors the pixels of a picture, or adds them to the mean, of which the last picture writes the pixels.
/// @param pixels  of whole tiles, row by row; as the last picture with this cache left them
void colorPixels(const PictureJob& job, const PictureMean& mean, BackgroundCache& cache, std::span<PixelColor> pixels);

/// What the job's first sample of each pixel of the picture hits, row by row.
std::vector<VisiblePoint> visiblePoints(const PictureJob& job);

}  // namespace render
