// The one call of render/ that makes pictures: a view in, pixels out.
#pragma once

#include <memory>
#include <vector>

#include "render/cpu/draw_times.h"
#include "render/opengl/context.h"
#include "render/picture/image.h"
#include "render/picture/view.h"

namespace render {

/// Draws views of one size and quality. Frames may come from different threads, one at a time.
/// Holds:  the same view gives the same bytes: from run to run, for any number of threads, and with either backend.
class Renderer {
 public:
    /// The context must outlive the renderer. Throws SystemError beyond OpenGL's largest picture.
    Renderer(Context& context, PictureSize size, Quality quality);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Throws SystemError where OpenGL fails or a list outgrows its limits, and then no longer knows what it keeps of
    /// the last picture: draw no more with it. Throws std::logic_error for a view with numbers that are not finite.
    /// old: a picture that is no longer needed, whose memory is used again.
    Image draw(const View& view, Image old = {});

    /// The surfaces that a picture of the view shows, row by row from the top left; found as for the picture.
    std::vector<VisiblePoint> visiblePoints(const View& view);

    /// Of the last picture drawn.
    const DrawTimes& times() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace render
