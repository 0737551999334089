// What a renderer does with a prepared view. render/cpu and render/opengl implement it, and the Renderer chooses one.
#pragma once

#include <vector>

#include "render/picture/draw_times.h"
#include "render/picture/layers.h"
#include "render/prepare/prepared_view.h"

namespace render {

class ViewRenderer {
 public:
    ViewRenderer() = default;
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;
    virtual ~ViewRenderer() = default;

    /// Draws layers of a view, the image without its overlay.
    /// @param layers  of a picture that is no longer needed, whose memory is reused
    /// @param times  the times of the stages are added to it
    /// @throws std::logic_error  for a layer that the renderer cannot draw
    virtual void draw(const PreparedView& view, const LayerSelection& wanted, Layers& layers, DrawTimes& times) = 0;
};

}  // namespace render
