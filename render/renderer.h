// The renderer: a view in, pixels out. There are two, which draw the same picture: one on the CPU's vector units
// (render/cpu), whose pictures are the same bits on every machine, and one in OpenGL's shaders (render/opengl).
#pragma once

#include <memory>
#include <vector>

#include "render/opengl/context/context.h"
#include "render/picture/draw_times.h"
#include "render/picture/layers.h"
#include "render/picture/view.h"

namespace render {

/// Draws views of one size and quality. It may be called from different threads, one at a time. The same view gives the
/// same bytes in every run and with any number of threads.
class Renderer {
 public:
    /// The renderer on the CPU.
    Renderer(PictureSize size, Quality quality);
    /// The renderer in OpenGL's shaders.
    /// @param context  must outlive the renderer
    /// @throws SystemError if OpenGL cannot draw pictures of this size
    Renderer(Context& context, PictureSize size, Quality quality);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws a view. After an exception the renderer must not draw again, because tiles of background that it keeps
    /// from the last picture may be wrong.
    /// @param old  an image that is no longer needed, whose memory is reused
    /// @throws SystemError  if OpenGL fails, or if the tiles' lists of spheres or lines become too long
    /// @throws std::logic_error  if the view has numbers that are not finite, or a shutter without a moment for each
    /// sample
    Image draw(const View& view, Image old = {});

    /// Draws layers of a view. Each has the same bytes whichever others are drawn with it. OpenGL draws no
    /// colors with alpha and no ids. Shutter and lens blur the layers that have colors; points and ids show the view's
    /// own moment from the middle of the lens.
    /// @param layers  those of a picture that is no longer needed, whose memory is reused
    /// @throws as draw() above
    /// @throws std::logic_error  if OpenGL is to draw one that it does not, or View::particleIds are missing
    void draw(const View& view, const LayerSelection& wanted, Layers& layers);

    /// The point of a surface that each pixel of the view's picture shows, row by row from the top left, found as for
    /// the picture.
    std::vector<VisiblePoint> visiblePoints(const View& view);

    /// The times that the stages of the last picture took.
    const DrawTimes& times() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace render
