// An off-screen OpenGL context of Mesa's software renderer, for machines without a display. Made by tools/ once per run
// and handed to the Renderer. OSMesa left Mesa in 25.1, hence two backends that give the same pixels.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "render/opengl/gl.h"

namespace render {

enum class Backend { osmesa, egl };

/// "osmesa" or "egl"; empty for any other name.
std::optional<Backend> backendNamed(std::string_view name);

/// Every name that backendNamed takes, for messages.
inline constexpr std::string_view kBackendNames = "osmesa, egl";

/// What a backend has to provide; one implementation in context_osmesa.cpp, one in context_egl.cpp.
class NativeContext {
 public:
    NativeContext() = default;
    NativeContext(const NativeContext&) = delete;
    NativeContext& operator=(const NativeContext&) = delete;
    virtual ~NativeContext() = default;
    virtual void makeCurrent() = 0;
    virtual void release() = 0;
    virtual void* address(const char* name) = 0;
};

/// Throws SystemError where this build or this machine has no such backend.
std::unique_ptr<NativeContext> makeOsmesaContext();
std::unique_ptr<NativeContext> makeEglContext();

/// An OpenGL 3.3 core (or later) context. Current on no thread after construction; successive frames may be drawn from
/// different threads as long as one releases it before the next makes it current.
class Context {
 public:
    /// Throws SystemError: no such library, no OpenGL 3.3, or a renderer that is not Mesa's software renderer.
    explicit Context(Backend backend);

    /// Binds the context to the calling thread.
    void makeCurrent() { native_->makeCurrent(); }
    /// Unbinds the context from the calling thread.
    void release() { native_->release(); }

    /// OpenGL's own name of the renderer, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& rendererName() const { return rendererName_; }
    const Gl& gl() const { return gl_; }

 private:
    std::unique_ptr<NativeContext> native_;
    Gl gl_;
    std::string rendererName_;
};

/// Keeps a context current for the life of the object, however its scope is left.
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
