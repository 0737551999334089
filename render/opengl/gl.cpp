// Fills the table of OpenGL functions. Called once per context.
#include "render/opengl/gl.h"

#include <cstring>
#include <string>

#include "render/picture/system_error.h"

namespace render {

namespace {

template <typename Function>
Function lookUp(const std::function<void*(const char*)>& address, const char* name) {
    void* found = address(name);
    if (found == nullptr) throw SystemError(std::string("OpenGL lacks the function ") + name);
    Function function = nullptr;
    static_assert(sizeof(function) == sizeof(found));
    std::memcpy(&function, &found, sizeof(found));  // ISO C++ has no cast from object to function pointers
    return function;
}

}  // namespace

Gl loadGl(const std::function<void*(const char*)>& address) {
    Gl gl;
#define RENDER_GL_LOAD(name, type) gl.name = lookUp<type>(address, "gl" #name);
    RENDER_GL_FUNCTIONS(RENDER_GL_LOAD)
#undef RENDER_GL_LOAD
    return gl;
}

}  // namespace render
