// An off-screen OpenGL context, for machines with or without a display or a GPU. Opened by tools/ for the renderer that
// draws with OpenGL, and given to it.
#pragma once

#include <memory>
#include <string>

#include "render/opengl/context/device.h"

namespace render {

struct Gl;

/// A context of OpenGL 3.3 core or later. After construction it is current on no thread. Frames may be drawn from
/// different threads as long as each releases it before the next makes it current.
class Context {
 public:
    /// @throws OpenGlError if the build or the machine lacks the library, the device or OpenGL 3.3
    explicit Context(const Device& device);
    Context(Context&&) noexcept;
    ~Context();

    /// Binds the context to the calling thread.
    void makeCurrent();
    /// Unbinds the context from the calling thread.
    void release();

    /// OpenGL's name of the renderer (GL_RENDERER), for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& rendererName() const;
    /// The version of OpenGL and of the driver (GL_VERSION), for example "4.5 (Core Profile) Mesa 22.3.6".
    const std::string& versionName() const;
    const Gl& gl() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Keeps a context current on the calling thread during the life of the object.
class CurrentContext {
 public:
    explicit CurrentContext(Context& context) : context_(context) { context_.makeCurrent(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
    ~CurrentContext();

 private:
    Context& context_;
};

}  // namespace render
