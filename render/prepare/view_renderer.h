// What a renderer does with a prepared view. render/cpu and render/opengl implement it, and the Renderer chooses one.
#pragma once

#include <vector>

#include "render/picture/draw_times.h"
#include "render/picture/layers.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// Some of the samples that the pixels of a picture of final quality have, of which a prepared view shows no others.
struct SampleRange {
    int begin = 0;
    int end = 0;         ///< one more than the last
    int perAxis = 3;     ///< the square of this number is how many a pixel has
    bool isOnly = true;  ///< whether one view shows all samples of the picture

    int count() const { return perAxis * perAxis; }
};

class ViewRenderer {
 public:
    ViewRenderer() = default;
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;
    virtual ~ViewRenderer() = default;

    /// Draws layers of a view, the image without its overlay. Where the samples of a picture show different views, each
    /// is drawn by a call of its own, one after another, and the last one completes the layers.
    /// @param samples  that are drawn in final quality; of no meaning in others
    /// @param layers  of a picture that is no longer needed, whose memory is reused
    /// @param times  the times of the stages are added to it
    /// @throws std::logic_error  for a layer that the renderer cannot draw
    virtual void draw(const PreparedView& view, const SampleRange& samples, const LayerSelection& wanted,
                      Layers& layers, DrawTimes& times) = 0;
};

}  // namespace render
