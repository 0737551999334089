// OpenGL handles that free themselves. All need their context current while they live, are used and die.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "render/opengl/gl.h"

namespace render {

/// Owns one GL name; Delete frees it.
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

/// OpenGL's picture: pixels of a fixed number, row by row, in memory a word each. Throws SystemError where OpenGL
/// cannot make it.
///
/// OpenGL is told that the lowest byte is blue, although shade.h's PixelColor has red there: what goes in comes out
/// again, and llvmpipe keeps such pixels as they come.
class Target {
 public:
    Target(const Gl& gl, int width, int height);

    void put(std::span<const std::uint32_t> pixels) const;
    /// Reads some of its rows; room: for all their pixels.
    void readRows(int first, int count, std::uint32_t* room) const;

 private:
    const Gl* gl_;
    int width_;
    int height_;
    TextureName pixels_;
    FramebufferName framebuffer_;
};

/// Throws SystemError with OpenGL's error code where anything failed since the last call.
void checkGl(const Gl& gl, std::string_view doing);

}  // namespace render
