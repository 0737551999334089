// The one call of render/ that makes pictures: a view in, pixels out.
#pragma once

#include <memory>

#include "render/context.h"
#include "render/image.h"
#include "render/view.h"

namespace render {

/// Where the time of one picture went, in seconds.
struct DrawTimes {
    double prepare = 0.0;  ///< binning, uploads, the metaballs' shadow map
    double cast = 0.0;     ///< ray casting of metaballs on the CPU
    double draw = 0.0;     ///< OpenGL, reading the pixels back included
};

/// Draws views of one size and quality. Frames may come from different threads, one at a time.
/// Holds:  the same view gives the same bytes: from run to run, for any number of threads, and with either backend.
class Renderer {
 public:
    /// The context must outlive the renderer. Throws SystemError beyond OpenGL's largest picture.
    Renderer(Context& context, PictureSize size, Quality quality);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Throws SystemError where OpenGL fails or a list outgrows its limits, std::logic_error for a view with numbers
    /// that are not finite.
    Image draw(const View& view);

    /// Of the last picture drawn.
    const DrawTimes& times() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace render
