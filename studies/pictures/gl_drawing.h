// What drawing with OpenGL takes: handles, and shader programs from their sources. Used by quad_baseline.cpp.
#pragma once

#include <string>

#include "render/opengl/gl.h"

namespace studies {

inline void deleteBuffer(const render::Gl& gl, GLuint name) {
    gl.DeleteBuffers(1, &name);
}
inline void deleteVertexArray(const render::Gl& gl, GLuint name) {
    gl.DeleteVertexArrays(1, &name);
}
inline void deleteProgram(const render::Gl& gl, GLuint name) {
    gl.DeleteProgram(name);
}

using BufferName = render::GlName<deleteBuffer>;
using VertexArrayName = render::GlName<deleteVertexArray>;
using ProgramName = render::GlName<deleteProgram>;

/// A linked program; throws SystemError with the compiler's or linker's words.
ProgramName buildProgram(const render::Gl& gl, const std::string& vertex, const std::string& fragment);

}  // namespace studies
