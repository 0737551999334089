// The passes over a picture, and everything else of the OpenGL renderer that lives in the context. The context is
// current wherever they are made, used and destroyed. Used by opengl_renderer.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/opengl/mesh_passes.h"
#include "render/opengl/metaball_passes.h"
#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/marked_fragments.h"
#include "render/opengl/objects/shader_program.h"
#include "render/opengl/transparency_buffers.h"
#include "render/opengl/view_buffers.h"
#include "render/prepare/prepared_view.h"
#include "render/prepare/view_renderer.h"

namespace render {

/// What a pass over the picture writes for each pixel.
struct PassOutput {
    const char* define = "";  ///< definition for the shaders; empty for the color, encoded
    int samples = 1;          ///< samples per pixel
    TextureBinding sums{};    ///< with "SUM": the sums of the samplings before
};

class PicturePasses {
 public:
    /// @param size  of the picture, in whole tiles
    /// @throws OpenGlError if OpenGL cannot draw pictures of this size
    PicturePasses(const Gl& gl, PictureSize size, Quality quality);

    PictureSize size() const { return size_; }

    /// Hands a view over to OpenGL.
    void upload(const PreparedView& view);

    /// Draws the view that was handed over.
    /// @param samples  that are drawn of it, in final quality
    /// @param pixels  receives the pixels, row by row in whole tiles, red in the lowest byte
    /// @return whether that completes the picture; without that there are no pixels yet
    bool drawPicture(const PreparedView& view, const SampleRange& samples, std::vector<std::uint32_t>& pixels);

    /// The normal and, in w, the view depth of the point that each pixel of a picture shows; w is -1 without one.
    /// @param size  of the picture
    std::vector<glm::vec4> visiblePoints(const PreparedView& view, PictureSize size);

 private:
    void bindState() const;
    bool drawMean(const PreparedView& view, const SampleRange& samples);
    void drawSampling(const PreparedView& view, glm::vec2 offset, const Target& target, const PassOutput& output);
    void drawTiles(const PreparedView& view, TileClass kind, const PassOutput& output);
    void drawSilhouettes(const PreparedView& view, TileClass kind, const PassOutput& output,
                         std::span<std::uint32_t> pixels);
    void uploadFrame(const PreparedView& view, glm::vec2 offset) const;
    Defines definesOf(const PreparedView& view, TileClass kind, const PassOutput& output) const;
    std::vector<TextureBinding> texturesOf(const PreparedView& view) const;
    void uploadMeshes(const PreparedView& view);
    void setUniforms(const PreparedView& view, const ShaderProgram& program) const;

    const Gl& gl_;
    PictureSize size_;
    Quality quality_;
    bool hasManyVaryings_;  // whether the vertex shader can hand the block Frame over
    VertexArrayName vertexArray_;
    BufferName frameBlock_;
    ShaderPrograms programs_;
    ViewBuffers buffers_;
    std::optional<MetaballPasses> metaballs_;
    std::optional<MeshPasses> meshes_;
    std::optional<TransparencyBuffers> transparency_;
    MarkedFragments silhouettes_;
    std::optional<Target> samples_;  // pixels of silhouettes, side by side
    Target picture_;                 // sRGB pixels
    std::vector<Target> sums_;       // in final quality: sums of linear colors, of which one is read and one is written
};

}  // namespace render
