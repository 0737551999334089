// The few dozen OpenGL functions that render/ and the studies' baseline call, as one table per context. Loaded by hand
// because the usual loaders look for a GLX or EGL context and abort under OSMesa.
#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace render {

// name without "gl", type
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

/// Looks every function up by its full name; throws SystemError with the name of the first that is missing.
Gl loadGl(const std::function<void*(const char*)>& address);

}  // namespace render
