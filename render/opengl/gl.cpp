// Loads the table of functions, and creates objects with all limits checked that depend on the size of the picture.
#include "render/opengl/gl.h"

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

template <typename Function>
Function lookUp(const std::function<GlFunction(const char*)>& address, const char* name) {
    const GlFunction found = address(name);
    if (found == nullptr) throw SystemError(fmt::format("OpenGL lacks the function {}", name));
    return reinterpret_cast<Function>(found);
}

constexpr GLenum kPixelOrder = GL_BGRA;
constexpr GLenum kPixelType = GL_UNSIGNED_INT_8_8_8_8_REV;

template <typename Name>
Name generate(const Gl& gl, void (*make)(GLsizei, GLuint*)) {
    GLuint name = 0;
    make(1, &name);
    return Name(gl, name);
}

GLint limitOf(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

}  // namespace

Gl loadGl(const std::function<GlFunction(const char*)>& address) {
    Gl gl;
#define RENDER_GL_LOAD(name, type) gl.name = lookUp<type>(address, "gl" #name);
    RENDER_GL_FUNCTIONS(RENDER_GL_LOAD)
#undef RENDER_GL_LOAD
    return gl;
}

Target::Target(const Gl& gl, int width, int height)
    : gl_(&gl),
      width_(width),
      height_(height),
      pixels_(generate<TextureName>(gl, gl.GenTextures)),
      framebuffer_(generate<FramebufferName>(gl, gl.GenFramebuffers)) {
    const GLint limit = limitOf(gl, GL_MAX_TEXTURE_SIZE);
    if (width > limit || height > limit) {
        throw SystemError(
            fmt::format("a picture of {} x {} pixels is larger than OpenGL's limit of {}", width, height, limit));
    }
    gl.BindTexture(GL_TEXTURE_2D, pixels_.get());
    // No mipmap levels.
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, kPixelOrder, kPixelType, nullptr);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, pixels_.get(), 0);
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        if (gl.GetError() == GL_OUT_OF_MEMORY)
            throw SystemError(fmt::format("OpenGL has not got the {:.0f} MB of memory for {} x {} pixels; choose fewer",
                                          4e-6 * width * height, width, height));
        throw SystemError(
            fmt::format("OpenGL cannot draw to {} x {} pixels: framebuffer status 0x{:04x}", width, height, status));
    }
}

void Target::put(std::span<const std::uint32_t> pixels) const {
    gl_->BindTexture(GL_TEXTURE_2D, pixels_.get());
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, kPixelOrder, kPixelType, pixels.data());
}

void Target::readRows(int first, int count, std::uint32_t* pixels) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl_->ReadPixels(0, first, width_, count, kPixelOrder, kPixelType, pixels);
}

void checkGl(const Gl& gl, std::string_view doing) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;
    const char* meaning = error == GL_OUT_OF_MEMORY ? " (out of memory)" : "";
    throw SystemError(fmt::format("OpenGL error 0x{:04x}{} while {}", error, meaning, doing));
}

}  // namespace render
