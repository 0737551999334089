// The colors of a picture's pixels, tile by tile. Called by cpu_renderer.cpp.
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
#include "render/prepare/prepared_view.h"

namespace render {

/// Everything that the pixels of one picture are colored from.
struct PictureJob {
    TileContents contents;
    SampleOffsets offsets;
    ShadingGeometry geometry;
    std::optional<Occluders> occluders;  ///< empty if nothing casts shadows or occludes the sky
    const Shading& shading;
    const PreparedView* transparent = nullptr;  ///< the view if it has transparent bodies, else null
};

/// A picture that is the mean of several samplings, which are colored one after another.
struct PictureMean {
    std::size_t index = 0;           ///< number of earlier samplings of the same picture
    std::size_t count = 1;           ///< number of samplings
    bool isOfOneView = true;         ///< whether all samplings show the same view
    std::vector<PointColors>& sums;  ///< per tile: sums of the colors so far; not used if count is 1
};

/// Remembers which tiles of the last picture show nothing but background, or nothing but ground that nothing occludes.
/// Their pixels are kept in the next picture while the camera, the background and the ground do not change. In a film
/// whose camera rests this saves a twentieth of the time to draw a frame (measured by perf on `globular bench --filter
/// "draw frame solid"`).
class BackgroundCache {
 public:
    /// Starts a picture. Forgets all tiles if the camera, the background or the ground has changed since the last one.
    void begin(const ShadingGeometry& geometry, const Shading& shading, std::size_t tileCount);

    /// Notes what a tile shows in this picture. @return whether the pixels of the tile show it already
    bool keeps(std::size_t tile, TileKind kind);

    /// Notes what a tile shows in one of the samplings of a picture, which show different views.
    /// @param isFirst  whether it is the first sampling of the picture
    void note(std::size_t tile, TileKind kind, bool isFirst);

    /// Whether a tile showed the same in all samplings so far, and that is nothing but background or open ground.
    bool isSteady(std::size_t tile) const;

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

/// Colors the pixels of a picture. If the picture is a mean of several samplings, their colors are added up, and the
/// last sampling writes the pixels. A tile that shows nothing but background or open ground in all samplings, before a
/// camera that does not move, has the pixels that it has in a picture of one view.
/// @param pixels  pixels of all tiles, row by row, as the last picture with this cache left them
void colorPixels(const PictureJob& job, const PictureMean& mean, BackgroundCache& cache, std::span<PixelColor> pixels);

/// Colors the pixels of the layer Layers::color. If the picture is a mean of several samplings, the layer has the sum
/// of their colors until the last.
/// @param job  with a black background
void colorLayer(const PictureJob& job, std::size_t index, std::size_t count, std::vector<glm::vec4>& layer);

}  // namespace render
