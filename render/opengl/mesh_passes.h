// The mesh obstacles of a picture as triangles of OpenGL: what the samples of the pixels show of them, and the depth
// map of their shadows. Used by picture_passes.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/shader_program.h"
#include "render/opengl/seen_triangles.h"
#include "render/prepare/prepared_view.h"

namespace render {

class MeshPasses {
 public:
    /// @param size  of the picture, in whole tiles
    MeshPasses(const Gl& gl, ShaderPrograms& programs, PictureSize size);

    /// Hands the meshes of a view over to OpenGL. @pre the view has some
    void upload(const PreparedView& view);

    /// Whether a tile may show a mesh.
    const std::vector<char>& tiles() const { return seen_.tiles; }

    /// Draws the depth map, if the meshes cast shadows.
    void drawDepthMap(const PreparedView& view);

    /// Draws what samples of each pixel show of the meshes.
    /// @param offsets  of the samples from the middle of their pixel, pixels; at most four
    void draw(const PreparedView& view, std::span<const glm::vec2> offsets);

    /// Adds the samplers of shaders/meshes.glsl and shaders/light.glsl, and their textures.
    void addBindings(std::vector<TextureBinding>& to) const;
    /// Adds the samplers of shaders/solid_hits.glsl for the corners of triangles.
    void addCorners(std::vector<TextureBinding>& to) const;
    /// Sets the uniforms of shaders/light.glsl in the program in use.
    void setUniforms(const PreparedView& view, const ShaderProgram& program) const;

 private:
    void drawTriangles(const BufferName& indices, std::size_t count) const;

    const Gl& gl_;
    ShaderPrograms& programs_;
    PictureSize size_;
    TextureBuffer corners_, normals_, colors_;
    BufferName seenIndices_, unlitIndices_;  // of corners, three for each triangle
    SeenTriangles seen_;
    std::size_t unlitCount_ = 0;
    std::vector<Target> samples_;  // shaders/mesh.frag writes one for each sample of a pixel
    std::optional<Target> map_;    // 0 at the top of the map, 1 at its bottom and where there is no mesh
};

}  // namespace render
