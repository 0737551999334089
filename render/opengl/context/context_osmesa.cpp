// OSMesa: Mesa's software renderer as a plain library, which needs neither a display server nor device files.
#include "render/opengl/context/context_native.h"
#include "render/picture/system_error.h"

#ifdef RENDER_HAS_OSMESA

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

namespace render {

namespace {

class OsmesaContext final : public NativeContext {
 public:
    OsmesaContext() {
        const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                                OSMESA_RGBA,
                                                OSMESA_PROFILE,
                                                OSMESA_CORE_PROFILE,
                                                OSMESA_CONTEXT_MAJOR_VERSION,
                                                3,
                                                OSMESA_CONTEXT_MINOR_VERSION,
                                                3,
                                                OSMESA_DEPTH_BITS,
                                                0,
                                                OSMESA_STENCIL_BITS,
                                                0,
                                                0};
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (context_ == nullptr) throw OpenGlError("OSMesa cannot create an OpenGL 3.3 core context");
    }
    ~OsmesaContext() override { OSMesaDestroyContext(context_); }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    void makeCurrent() override {
        // OSMesa requires a buffer to draw to, but everything is drawn to framebuffer objects.
        if (OSMesaMakeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            throw OpenGlError("OSMesa cannot make its context current");
        }
    }
    void release() override {
        if (OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0) == GL_FALSE) {
            throw OpenGlError("OSMesa cannot release its context");
        }
    }
    GlFunction address(const char* name) override { return OSMesaGetProcAddress(name); }

 private:
    ::OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, 4> unused_{};
};

}  // namespace

std::unique_ptr<NativeContext> makeOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace render

#else

std::unique_ptr<render::NativeContext> render::makeOsmesaContext() {
    throw OpenGlError("this globular was built without OSMesa (libosmesa6-dev)");
}

#endif
