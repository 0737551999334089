// An off-screen OpenGL context of Mesa's software renderer, for machines without a display. Created by tools/ once per
// run and given to the Renderer. There are two backends, which give the same pixels, because Mesa 25.1 removed OSMesa.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "render/opengl/gl.h"

namespace render {

enum class Backend { osmesa, egl };

/// The backend named "osmesa" or "egl"; nothing for any other name.
std::optional<Backend> backendNamed(std::string_view name);

/// The names that backendNamed() knows, for messages.
inline constexpr std::string_view kBackendNames = "osmesa, egl";

/// What a backend provides. The implementations are in context_osmesa.cpp and context_egl.cpp.
class NativeContext {
 public:
    NativeContext() = default;
    NativeContext(const NativeContext&) = delete;
    NativeContext& operator=(const NativeContext&) = delete;
    virtual ~NativeContext() = default;
    virtual void makeCurrent() = 0;
    virtual void release() = 0;
    virtual GlFunction address(const char* name) = 0;
};

/// @throws SystemError when the build or the machine lacks the backend
std::unique_ptr<NativeContext> makeOsmesaContext();
std::unique_ptr<NativeContext> makeEglContext();

/// A context of OpenGL 3.3 core or later. After construction it is current on no thread. Frames may be drawn from
/// different threads as long as each releases it before the next makes it current.
class Context {
 public:
    /// @throws SystemError without the library, without OpenGL 3.3, or for a renderer other than Mesa's software
    /// renderer
    explicit Context(Backend backend);

    /// Binds the context to the calling thread.
    void makeCurrent() { native_->makeCurrent(); }
    /// Unbinds the context from the calling thread.
    void release() { native_->release(); }

    /// OpenGL's name of the renderer, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& rendererName() const { return rendererName_; }
    const Gl& gl() const { return gl_; }

 private:
    std::unique_ptr<NativeContext> native_;
    Gl gl_;
    std::string rendererName_;
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
