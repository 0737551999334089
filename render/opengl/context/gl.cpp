// Loads the table of functions and reports OpenGL's errors.
#include "render/opengl/context/gl.h"

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

template <typename Function>
Function lookUp(const std::function<GlFunction(const char*)>& address, const char* name) {
    const GlFunction found = address(name);
    if (found == nullptr) throw OpenGlError(fmt::format("OpenGL lacks the function {}", name));
    return reinterpret_cast<Function>(found);
}

}  // namespace

Gl loadGl(const std::function<GlFunction(const char*)>& address) {
    Gl gl;
#define RENDER_GL_LOAD(name, type) gl.name = lookUp<type>(address, "gl" #name);
    RENDER_GL_FUNCTIONS(RENDER_GL_LOAD)
#undef RENDER_GL_LOAD
    return gl;
}

void checkGl(const Gl& gl, std::string_view doing) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;
    const char* meaning = error == GL_OUT_OF_MEMORY ? " (out of memory)" : "";
    throw OpenGlError(fmt::format("OpenGL error 0x{:04x}{} while {}", error, meaning, doing));
}

GLint limitOf(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

}  // namespace render
