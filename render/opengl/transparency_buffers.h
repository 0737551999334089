// What the shaders read to follow rays through transparent bodies, in OpenGL's memory. Used by picture_passes.cpp.
#pragma once

#include <vector>

#include "render/opengl/objects/gl_objects.h"
#include "render/opengl/objects/shader_program.h"
#include "render/prepare/prepared_view.h"

namespace render {

class TransparencyBuffers {
 public:
    explicit TransparencyBuffers(const Gl& gl);

    /// Hands a view with transparent bodies over to OpenGL.
    /// @throws OpenGlError if a list is too long for OpenGL, or memory runs out
    void upload(const PreparedView& view);

    /// Adds the samplers of shaders/field_crossing.glsl, solid_hits.glsl and light.glsl, and their textures.
    void addBindings(std::vector<TextureBinding>& to) const;
    /// Sets the uniforms of these shaders in the program in use.
    static void setUniforms(const PreparedView& view, const ShaderProgram& program);

 private:
    void uploadBalls(const PreparedView& view);
    void uploadSolids(const PreparedView& view);
    void uploadOpticalDepths(const PreparedView& view);

    TextureBuffer cellNumbers_, cellBalls_, cellSky_;
    TextureBuffer nodes_, links_, solids_, triangles_, media_;
    TextureBuffer opticalDepths_;
};

}  // namespace render
