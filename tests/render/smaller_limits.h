// Lets a context report smaller limits than it has, as other implementations of OpenGL do.
#pragma once

#include <map>

#include "render/opengl/context/context.h"
#include "render/opengl/context/gl.h"

namespace pictures {

/// While it lives, all contexts that it is made for report these limits.
class SmallerLimits {
 public:
    /// @param limits  by their names, such as GL_MAX_TEXTURE_SIZE
    SmallerLimits(render::Context& context, std::map<GLenum, GLint> limits)
        // The functions are the context's own data, which it hands out as constant.
        : gl_(const_cast<render::Gl&>(context.gl())) {
        limits_ = std::move(limits);
        getInteger_ = gl_.GetIntegerv;
        gl_.GetIntegerv = [](GLenum name, GLint* value) {
            getInteger_(name, value);
            if (const auto found = limits_.find(name); found != limits_.end()) *value = found->second;
        };
    }
    ~SmallerLimits() { gl_.GetIntegerv = getInteger_; }
    SmallerLimits(const SmallerLimits&) = delete;
    SmallerLimits& operator=(const SmallerLimits&) = delete;

 private:
    // OpenGL's functions have no argument for data of the caller.
    static inline PFNGLGETINTEGERVPROC getInteger_ = nullptr;
    static inline std::map<GLenum, GLint> limits_;
    render::Gl& gl_;
};

}  // namespace pictures
