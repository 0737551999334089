// What the two libraries of OpenGL contexts provide, in context_osmesa.cpp and context_egl.cpp. Used by context.cpp.
#pragma once

#include <memory>
#include <string>

#include "render/opengl/context/gl.h"

namespace render {

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

/// @throws OpenGlError if the build has no OSMesa, or OSMesa no OpenGL 3.3 core
std::unique_ptr<NativeContext> makeOsmesaContext();

/// A context on the device with this number. With a number below zero, on the first device that is a GPU; without one,
/// on EGL's software device; or else on no device, which Mesa's surfaceless platform offers.
/// @throws OpenGlError if the build has no EGL, there is no such device, or it has no OpenGL 3.3 core
std::unique_ptr<NativeContext> makeEglContext(int index);

/// How many devices EGL lists; 0 in a build without EGL.
int eglDeviceCount();

/// Whether a renderer with this name (GL_RENDERER) is one of Mesa's that draw on the CPU.
bool isSoftwareRenderer(const std::string& name);

}  // namespace render
