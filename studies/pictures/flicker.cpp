// Measures flicker: how successive pictures differ while the camera moves slowly. See FlickerRow in pictures.h.

#include <cmath>

#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/pictures.h"
#include "studies/pictures/renderers.h"

namespace studies {
namespace {

/// The view in a frame. Between frames the camera moves to the right by settings.pixelsPerFrame.
render::View shifted(render::View view, const FlickerSettings& settings, int frame) {
    const glm::vec3 aim = view.camera.target - view.camera.eye;
    const glm::vec3 right = glm::normalize(glm::cross(aim, view.camera.up));
    const double pixel =
        2.0 * std::tan(0.5 * double(view.camera.verticalFov)) * double(glm::length(aim)) / settings.size.height;
    const auto step = static_cast<float>(settings.pixelsPerFrame * pixel * frame);
    view.camera.eye += step * right;
    view.camera.target += step * right;
    return view;
}

/// Measures the change and the jerk of successive pictures; FlickerRow says what these are.
FlickerRow flickerOf(const PictureSubject& subject, const std::vector<render::Image>& frames) {
    FlickerRow row{subject};
    const auto count = static_cast<double>(frames.front().rgb.size());
    for (std::size_t k = 1; k < frames.size(); ++k) {
        double changes = 0.0;
        double jerks = 0.0;
        for (std::size_t byte = 0; byte < frames[k].rgb.size(); ++byte) {
            const double step = double(frames[k].rgb[byte]) - double(frames[k - 1].rgb[byte]);
            const double last = k < 2 ? step : double(frames[k - 1].rgb[byte]) - double(frames[k - 2].rgb[byte]);
            changes += step * step;
            jerks += (step - last) * (step - last);
        }
        row.change += std::sqrt(changes / count) / static_cast<double>(frames.size() - 1);
        row.jerk += std::sqrt(jerks / count) / static_cast<double>(frames.size() - 2);
    }
    return row;
}

}  // namespace

std::vector<FlickerRow> measureFlicker(const FlickerSettings& settings, render::Context* context,
                                       const RowsListener<FlickerRow>& listener) {
    std::vector<FlickerRow> rows;
    for (const render::Style style : kStyles) {
        const render::View view = damBreakView(settings.particles, style);
        for (const render::Quality quality : kQualities)
            for (const auto& [kind, renderer] : makeRenderers(context, settings.size, quality)) {
                std::vector<render::Image> frames;
                for (int frame = 0; frame < settings.frames; ++frame)
                    frames.push_back(renderer->draw(shifted(view, settings, frame)));
                rows.push_back(flickerOf({style, settings.particles, settings.size, quality, kind}, frames));
                listener(rows);
            }
    }
    return rows;
}

}  // namespace studies
