// OpenGL objects that free themselves: buffers that shaders read, textures that they draw to. Every object needs its
// context to be current while it is created, used and destroyed.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "render/opengl/context/gl.h"
#include "render/picture/view.h"

namespace render {

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

inline void deleteBuffer(const Gl& gl, GLuint name) {
    gl.DeleteBuffers(1, &name);
}
inline void deleteTexture(const Gl& gl, GLuint name) {
    gl.DeleteTextures(1, &name);
}
inline void deleteFramebuffer(const Gl& gl, GLuint name) {
    gl.DeleteFramebuffers(1, &name);
}
inline void deleteVertexArray(const Gl& gl, GLuint name) {
    gl.DeleteVertexArrays(1, &name);
}

using BufferName = GlName<deleteBuffer>;
using TextureName = GlName<deleteTexture>;
using FramebufferName = GlName<deleteFramebuffer>;
using VertexArrayName = GlName<deleteVertexArray>;

/// Makes one object with a function such as gl.GenTextures.
template <typename Name>
Name generate(const Gl& gl, void (*make)(GLsizei, GLuint*)) {
    GLuint name = 0;
    make(1, &name);
    return Name(gl, name);
}

/// A list of numbers that shaders read with texelFetch().
class TextureBuffer {
 public:
    /// @param format  of a texel, for example GL_RGBA32F
    TextureBuffer(const Gl& gl, GLenum format);

    /// Replaces the list.
    /// @param what  names the list in the message
    /// @throws OpenGlError if it has more texels than OpenGL allows, or OpenGL lacks the memory
    void upload(std::span<const std::byte> bytes, std::string_view what);

    GLuint texture() const { return texture_.get(); }

 private:
    const Gl* gl_;
    GLenum format_;
    std::size_t texelBytes_;
    BufferName buffer_;
    TextureName texture_;
};

/// Uploads a list of plain values.
template <typename Item>
void uploadList(TextureBuffer& buffer, const std::vector<Item>& items, std::string_view what) {
    // Shaders may read the first entries of an empty list, and ignore them.
    static const std::array<std::byte, 32> kNothing{};
    buffer.upload(items.empty() ? std::span<const std::byte>(kNothing) : std::as_bytes(std::span(items)), what);
}

/// Textures of one size that shaders draw to.
class Target {
 public:
    /// A texture for each format, for example GL_RGBA8. GL_DEPTH_COMPONENT32F makes the depth buffer.
    /// @throws OpenGlError if OpenGL cannot create textures of this size
    Target(const Gl& gl, PictureSize size, std::initializer_list<GLenum> formats);

    /// Binds the textures to be drawn to, and sets the viewport.
    void bind() const { bind(size_); }
    /// @param viewport  the part of the textures that is drawn to, from their corner
    void bind(PictureSize viewport) const;

    /// The texture of the format with this index.
    GLuint texture(std::size_t index) const { return textures_[index].get(); }
    PictureSize size() const { return size_; }

 private:
    const Gl* gl_;
    PictureSize size_;
    std::vector<TextureName> textures_;
    FramebufferName framebuffer_;
};

/// Four layers of an array texture of four unsigned integers each, which shaders draw to together.
class LayeredTarget {
 public:
    /// @param hasDepth  whether it has a depth buffer
    /// @throws OpenGlError if OpenGL cannot create textures of this size
    LayeredTarget(const Gl& gl, PictureSize size, bool hasDepth);

    /// Binds the layers to be drawn to.
    /// @param viewport  the part of the texture that is drawn to, from its corner
    void bind(PictureSize viewport) const;
    /// Sets all texels, and the depths, to 0. The target must be bound.
    void clear() const;

    GLuint texture() const { return texture_.get(); }
    PictureSize size() const { return size_; }

 private:
    const Gl* gl_;
    PictureSize size_;
    TextureName texture_;
    TextureName depth_;
    FramebufferName framebuffer_;
};

/// Makes shaders that look a depth texture up compare its depths with theirs: 1 where the texture's is less.
void compareDepths(const Gl& gl, GLuint texture);

}  // namespace render
