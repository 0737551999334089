// The OpenGL functions that render/ calls, as one table per context. They are loaded by hand, because the usual loaders
// look for a GLX or EGL context and abort under OSMesa.
#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <string_view>

namespace render {

// X(name without "gl", type of the pointer to the function)
#define RENDER_GL_FUNCTIONS(X)                                   \
    X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                     \
    X(AttachShader, PFNGLATTACHSHADERPROC)                       \
    X(BindBuffer, PFNGLBINDBUFFERPROC)                           \
    X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                   \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                 \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                         \
    X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                 \
    X(BlendFunc, PFNGLBLENDFUNCPROC)                             \
    X(BufferData, PFNGLBUFFERDATAPROC)                           \
    X(BufferSubData, PFNGLBUFFERSUBDATAPROC)                     \
    X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)   \
    X(ClearBufferfv, PFNGLCLEARBUFFERFVPROC)                     \
    X(ClearBufferuiv, PFNGLCLEARBUFFERUIVPROC)                   \
    X(CompileShader, PFNGLCOMPILESHADERPROC)                     \
    X(CreateProgram, PFNGLCREATEPROGRAMPROC)                     \
    X(CreateShader, PFNGLCREATESHADERPROC)                       \
    X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                     \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)           \
    X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                     \
    X(DeleteShader, PFNGLDELETESHADERPROC)                       \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                   \
    X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)           \
    X(DepthFunc, PFNGLDEPTHFUNCPROC)                             \
    X(DepthMask, PFNGLDEPTHMASKPROC)                             \
    X(Disable, PFNGLDISABLEPROC)                                 \
    X(DrawArrays, PFNGLDRAWARRAYSPROC)                           \
    X(DrawBuffers, PFNGLDRAWBUFFERSPROC)                         \
    X(DrawElements, PFNGLDRAWELEMENTSPROC)                       \
    X(Enable, PFNGLENABLEPROC)                                   \
    X(Finish, PFNGLFINISHPROC)                                   \
    X(FramebufferTexture, PFNGLFRAMEBUFFERTEXTUREPROC)           \
    X(FramebufferTextureLayer, PFNGLFRAMEBUFFERTEXTURELAYERPROC) \
    X(GenBuffers, PFNGLGENBUFFERSPROC)                           \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                 \
    X(GenTextures, PFNGLGENTEXTURESPROC)                         \
    X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                 \
    X(GetError, PFNGLGETERRORPROC)                               \
    X(GetFloatv, PFNGLGETFLOATVPROC)                             \
    X(GetIntegerv, PFNGLGETINTEGERVPROC)                         \
    X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)             \
    X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                       \
    X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)               \
    X(GetShaderiv, PFNGLGETSHADERIVPROC)                         \
    X(GetString, PFNGLGETSTRINGPROC)                             \
    X(GetUniformBlockIndex, PFNGLGETUNIFORMBLOCKINDEXPROC)       \
    X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)           \
    X(LinkProgram, PFNGLLINKPROGRAMPROC)                         \
    X(PixelStorei, PFNGLPIXELSTOREIPROC)                         \
    X(ReadPixels, PFNGLREADPIXELSPROC)                           \
    X(ShaderSource, PFNGLSHADERSOURCEPROC)                       \
    X(TexBuffer, PFNGLTEXBUFFERPROC)                             \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                           \
    X(TexImage3D, PFNGLTEXIMAGE3DPROC)                           \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                     \
    X(Uniform1i, PFNGLUNIFORM1IPROC)                             \
    X(Uniform2f, PFNGLUNIFORM2FPROC)                             \
    X(Uniform4f, PFNGLUNIFORM4FPROC)                             \
    X(UniformBlockBinding, PFNGLUNIFORMBLOCKBINDINGPROC)         \
    X(UseProgram, PFNGLUSEPROGRAMPROC)                           \
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
/// @throws OpenGlError with the name of the first function that is missing
Gl loadGl(const std::function<GlFunction(const char*)>& address);

/// @param doing  for the message, for example "drawing a frame"
/// @throws OpenGlError with OpenGL's error code if an OpenGL function has failed since the last call
void checkGl(const Gl& gl, std::string_view doing);

/// A limit of the implementation, such as GL_MAX_TEXTURE_SIZE.
GLint limitOf(const Gl& gl, GLenum name);

}  // namespace render
