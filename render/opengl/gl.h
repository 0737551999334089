// The OpenGL functions that render/ and the baseline of the studies call, as one table per context, and handles that
// own OpenGL objects. The functions are loaded by hand, because the usual loaders look for a GLX or EGL context and
// abort under OSMesa. Every object needs its context to be current while it is created, used and destroyed.
#pragma once

#include <GL/glcorearb.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>

namespace render {

// X(name without "gl", type of the pointer to the function)
#define RENDER_GL_FUNCTIONS(X)                                 \
    X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                   \
    X(AttachShader, PFNGLATTACHSHADERPROC)                     \
    X(BindBuffer, PFNGLBINDBUFFERPROC)                         \
    X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                 \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)               \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                       \
    X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)               \
    X(BufferData, PFNGLBUFFERDATAPROC)                         \
    X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC) \
    X(Clear, PFNGLCLEARPROC)                                   \
    X(ClearColor, PFNGLCLEARCOLORPROC)                         \
    X(CompileShader, PFNGLCOMPILESHADERPROC)                   \
    X(CreateProgram, PFNGLCREATEPROGRAMPROC)                   \
    X(CreateShader, PFNGLCREATESHADERPROC)                     \
    X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                   \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)         \
    X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                   \
    X(DeleteShader, PFNGLDELETESHADERPROC)                     \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                 \
    X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)         \
    X(DepthFunc, PFNGLDEPTHFUNCPROC)                           \
    X(Disable, PFNGLDISABLEPROC)                               \
    X(DrawArraysInstanced, PFNGLDRAWARRAYSINSTANCEDPROC)       \
    X(Enable, PFNGLENABLEPROC)                                 \
    X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)     \
    X(GenBuffers, PFNGLGENBUFFERSPROC)                         \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)               \
    X(GenTextures, PFNGLGENTEXTURESPROC)                       \
    X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)               \
    X(GetError, PFNGLGETERRORPROC)                             \
    X(GetIntegerv, PFNGLGETINTEGERVPROC)                       \
    X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)           \
    X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                     \
    X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)             \
    X(GetShaderiv, PFNGLGETSHADERIVPROC)                       \
    X(GetString, PFNGLGETSTRINGPROC)                           \
    X(GetUniformBlockIndex, PFNGLGETUNIFORMBLOCKINDEXPROC)     \
    X(LinkProgram, PFNGLLINKPROGRAMPROC)                       \
    X(PixelStorei, PFNGLPIXELSTOREIPROC)                       \
    X(ReadPixels, PFNGLREADPIXELSPROC)                         \
    X(ShaderSource, PFNGLSHADERSOURCEPROC)                     \
    X(TexBuffer, PFNGLTEXBUFFERPROC)                           \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                         \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                   \
    X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                   \
    X(UniformBlockBinding, PFNGLUNIFORMBLOCKBINDINGPROC)       \
    X(UseProgram, PFNGLUSEPROGRAMPROC)                         \
    X(Viewport, PFNGLVIEWPORTPROC)

/// OpenGL's functions, called as gl.ReadPixels(...).
struct Gl {
#define RENDER_GL_MEMBER(name, type) type name = nullptr;
    RENDER_GL_FUNCTIONS(RENDER_GL_MEMBER)
#undef RENDER_GL_MEMBER
};

/// A pointer to a function of any type.
using GlFunction = void (*)();

/// Looks up every function by its full name.
/// @throws SystemError with the name of the first function that is missing
Gl loadGl(const std::function<GlFunction(const char*)>& address);

/// Owns the name of an OpenGL object; Delete destroys it.
template <void (*Delete)(const Gl&, GLuint)>
class GlName {
 public:
    GlName() = default;
    GlName(const Gl& gl, GLuint name) : gl_(&gl), name_(name) {}
    GlName(GlName&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlName() {
        if (name_ != 0) Delete(*gl_, name_);
    }
    GLuint get() const { return name_; }

 private:
    const Gl* gl_ = nullptr;
    GLuint name_ = 0;
};

inline void deleteTexture(const Gl& gl, GLuint name) {
    gl.DeleteTextures(1, &name);
}
inline void deleteFramebuffer(const Gl& gl, GLuint name) {
    gl.DeleteFramebuffers(1, &name);
}

using TextureName = GlName<deleteTexture>;
using FramebufferName = GlName<deleteFramebuffer>;

/// A picture of a fixed size in a texture: finished pixels are put in and read back row by row, one 32-bit word each.
///
/// OpenGL is told that the lowest byte is blue, although shade.h's PixelColor has red there. It makes no difference to
/// pixels that are only stored, and llvmpipe copies pixels in this order without converting them.
class Target {
 public:
    /// @throws SystemError when OpenGL cannot create a picture of this size
    Target(const Gl& gl, int width, int height);

    void put(std::span<const std::uint32_t> pixels) const;
    /// Reads rows of pixels into a buffer that has room for them.
    void readRows(int first, int count, std::uint32_t* pixels) const;

 private:
    const Gl* gl_;
    int width_;
    int height_;
    TextureName pixels_;
    FramebufferName framebuffer_;
};

/// @param doing  for the message, for example "drawing a frame"
/// @throws SystemError with OpenGL's error code if an OpenGL function has failed since the last call
void checkGl(const Gl& gl, std::string_view doing);

}  // namespace render
