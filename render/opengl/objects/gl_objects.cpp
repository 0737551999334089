// Creates objects with all limits checked that depend on the size of the picture or the number of particles.
#include "render/opengl/objects/gl_objects.h"

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

constexpr GLint kLayers = 4;  // of a LayeredTarget

std::size_t bytesOf(GLenum format) {
    switch (format) {
        case GL_RGBA32F:
        case GL_RGBA32UI:
            return 16;
        default:
            return 4;
    }
}

/// The format and the type of pixels that textures of an internal format are made from; nothing is uploaded.
std::pair<GLenum, GLenum> pixelFormat(GLenum format) {
    switch (format) {
        case GL_RGBA8:
            return {GL_RGBA, GL_UNSIGNED_BYTE};
        case GL_RGBA32UI:
            return {GL_RGBA_INTEGER, GL_UNSIGNED_INT};
        case GL_DEPTH_COMPONENT32F:
            return {GL_DEPTH_COMPONENT, GL_FLOAT};
        default:
            return {GL_RGBA, GL_FLOAT};
    }
}

TextureName makeTexture(const Gl& gl, PictureSize size, GLenum format) {
    TextureName texture = generate<TextureName>(gl, gl.GenTextures);
    gl.BindTexture(GL_TEXTURE_2D, texture.get());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);  // no mipmap levels
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const auto [pixels, type] = pixelFormat(format);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), size.width, size.height, 0, pixels, type, nullptr);
    return texture;
}

void requireSize(const Gl& gl, PictureSize size) {
    const GLint limit = limitOf(gl, GL_MAX_TEXTURE_SIZE);
    if (size.width <= limit && size.height <= limit) return;
    throw OpenGlError(
        fmt::format("a picture of {} x {} pixels is larger than OpenGL's limit of {}", size.width, size.height, limit));
}

/// Throws unless the framebuffer that is bound can be drawn to. @param bytes  size of its textures
void requireComplete(const Gl& gl, PictureSize size, double bytes) {
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (gl.GetError() == GL_OUT_OF_MEMORY)
        throw OpenGlError(fmt::format("OpenGL has not got the {:.0f} MB of memory for {} x {} pixels", 1e-6 * bytes,
                                      size.width, size.height));
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw OpenGlError(fmt::format("OpenGL cannot draw to {} x {} pixels: framebuffer status 0x{:04x}", size.width,
                                  size.height, status));
}

}  // namespace

TextureBuffer::TextureBuffer(const Gl& gl, GLenum format)
    : gl_(&gl),
      format_(format),
      texelBytes_(bytesOf(format)),
      buffer_(generate<BufferName>(gl, gl.GenBuffers)),
      texture_(generate<TextureName>(gl, gl.GenTextures)) {}

void TextureBuffer::upload(std::span<const std::byte> bytes, std::string_view what) {
    const std::size_t texels = bytes.size() / texelBytes_;
    const auto most = static_cast<std::size_t>(limitOf(*gl_, GL_MAX_TEXTURE_BUFFER_SIZE));
    if (texels > most)
        throw OpenGlError(fmt::format("{} take {} texels, and OpenGL allows {} in a list", what, texels, most));
    gl_->BindBuffer(GL_TEXTURE_BUFFER, buffer_.get());
    gl_->BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
    gl_->BindTexture(GL_TEXTURE_BUFFER, texture_.get());
    gl_->TexBuffer(GL_TEXTURE_BUFFER, format_, buffer_.get());
    if (gl_->GetError() == GL_OUT_OF_MEMORY)
        throw OpenGlError(fmt::format("OpenGL has not got the {:.0f} MB of memory for {}",
                                      1e-6 * static_cast<double>(bytes.size()), what));
}

Target::Target(const Gl& gl, PictureSize size, std::initializer_list<GLenum> formats)
    : gl_(&gl), size_(size), framebuffer_(generate<FramebufferName>(gl, gl.GenFramebuffers)) {
    requireSize(gl, size);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    std::vector<GLenum> colors;
    double bytes = 0.0;
    for (const GLenum format : formats) {
        textures_.push_back(makeTexture(gl, size, format));
        bytes += static_cast<double>(bytesOf(format)) * size.width * size.height;
        const bool isDepth = format == GL_DEPTH_COMPONENT32F;
        const GLenum at = isDepth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colors.size());
        if (!isDepth) colors.push_back(at);
        gl.FramebufferTexture(GL_FRAMEBUFFER, at, textures_.back().get(), 0);
    }
    gl.DrawBuffers(static_cast<GLsizei>(colors.size()), colors.data());
    requireComplete(gl, size, bytes);
}

void Target::bind(PictureSize viewport) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl_->Viewport(0, 0, viewport.width, viewport.height);
}

LayeredTarget::LayeredTarget(const Gl& gl, PictureSize size, bool hasDepth)
    : gl_(&gl),
      size_(size),
      texture_(generate<TextureName>(gl, gl.GenTextures)),
      framebuffer_(generate<FramebufferName>(gl, gl.GenFramebuffers)) {
    requireSize(gl, size);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture_.get());
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32UI, size.width, size.height, kLayers, 0, GL_RGBA_INTEGER,
                  GL_UNSIGNED_INT, nullptr);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    std::vector<GLenum> attachments;
    for (GLint layer = 0; layer < kLayers; ++layer) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(layer));
        gl.FramebufferTextureLayer(GL_FRAMEBUFFER, attachments.back(), texture_.get(), 0, layer);
    }
    if (hasDepth) {
        depth_ = makeTexture(gl, size, GL_DEPTH_COMPONENT32F);
        gl.FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.get(), 0);
    }
    gl.DrawBuffers(kLayers, attachments.data());
    requireComplete(gl, size, static_cast<double>(kLayers * bytesOf(GL_RGBA32UI)) * size.width * size.height);
}

void LayeredTarget::clear() const {
    const std::array<GLuint, 4> nothing{};
    for (GLint layer = 0; layer < kLayers; ++layer) gl_->ClearBufferuiv(GL_COLOR, layer, nothing.data());
    const float nearest = 0.0F;
    if (depth_.get() != 0) gl_->ClearBufferfv(GL_DEPTH, 0, &nearest);
}

void LayeredTarget::bind(PictureSize viewport) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl_->Viewport(0, 0, viewport.width, viewport.height);
}

void compareDepths(const Gl& gl, GLuint texture) {
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GREATER);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace render
