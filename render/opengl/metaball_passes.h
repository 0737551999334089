// The passes that find the surface of the metaballs before the picture is colored: the depth map as the light sees it,
// coarse rays through every second pixel of every second row, and what the middle of each pixel shows. Used by
// opengl_renderer.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/marked_fragments.h"
#include "render/opengl/objects/shader_program.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// Whether the kernels of all balls are round and have the same radius.
bool hasOneReach(const MetaballScene& scene);

/// Metaballs in OpenGL's memory as a camera or the light sees them.
class BallBuffers {
 public:
    explicit BallBuffers(const Gl& gl);

    /// @throws OpenGlError if a list is too long for OpenGL, or memory runs out
    void upload(const MetaballScene& scene);

    void addBindings(std::vector<TextureBinding>& to) const;

    /// The tiles that balls reach.
    TextureBinding tiles() const { return {"tiles", GL_TEXTURE_BUFFER, tiles_.texture()}; }
    std::span<const std::int32_t> tileIndices() const { return tileIndices_; }

 private:
    TextureBuffer balls_, attributes_, begins_, items_, tiles_;
    std::vector<std::int32_t> tileIndices_;
};

class MetaballPasses {
 public:
    /// @param size  of the picture, in whole tiles
    MetaballPasses(const Gl& gl, ShaderPrograms& programs, PictureSize size);

    void upload(const PreparedView& view);

    /// Casts the depth map, which is moved by a part of a texel, and the pixels.
    /// @param defines  of the view's look, see look_defines.h
    /// @param castsAll  whether a ray is cast through every pixel, and none is interpolated
    void cast(const PreparedView& view, const Defines& defines, glm::vec2 offset, bool castsAll);

    /// What the passes over the picture read of the metaballs.
    void addBindings(std::vector<TextureBinding>& to) const;

 private:
    void castDepthMap(const PreparedView& view, const Defines& defines, glm::vec2 offset);
    void spreadDepths(PictureSize size);
    void castCoarseRays(const PreparedView& view, const Defines& defines) const;
    void castAllPixels(const PreparedView& view, const Defines& defines) const;
    void findPixelHits(const PreparedView& view, const Defines& defines);
    void castMarkedCells(const Defines& defines);
    void returnMarkedCells(const PreparedView& view, const Defines& defines);
    void drawBallTiles(const PreparedView& view, const char* shader, const Defines& defines) const;

    const Gl& gl_;
    ShaderPrograms& programs_;
    BallBuffers camera_;
    BallBuffers light_;
    LayeredTarget coarse_;         // of every 4 x 4 pixels, a layer for each of four rays
    LayeredTarget pixels_;         // of every 2 x 2 pixels, a layer for each
    MarkedFragments markedCells_;  // cells that are not smooth
    std::optional<LayeredTarget> markedHits_;
    TextureBuffer pixelsOfCells_;
    std::optional<Target> depths_;  // four depths for each texel of the map
    std::optional<Target> map_;     // the depth texture, a texel for each depth
};

}  // namespace render
