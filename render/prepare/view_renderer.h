// What a renderer does with a prepared view. render/cpu and render/opengl implement it, and the Renderer chooses one.
#pragma once

#include <vector>

#include "render/picture/draw_times.h"
#include "render/picture/image.h"
#include "render/prepare/prepared_view.h"

namespace render {

class ViewRenderer {
 public:
    ViewRenderer() = default;
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;
    virtual ~ViewRenderer() = default;

    /// Draws the picture of a view, without its overlay.
    /// @param image  an image that is no longer needed, whose memory is reused
    /// @param times  the times of the stages are added to it
    virtual Image draw(const PreparedView& view, Image image, DrawTimes& times) = 0;

    /// The point of a surface that each pixel of the picture shows, row by row.
    virtual std::vector<VisiblePoint> visiblePoints(const PreparedView& view) = 0;
};

}  // namespace render
