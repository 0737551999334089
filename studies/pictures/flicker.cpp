// Differences of pictures that follow one another.
#include "studies/pictures/flicker.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "render/renderer.h"
#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/pictures.h"

namespace studies {
namespace {

/// The view from a place so many pixels further to the right.
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

FlickerRow measured(const std::vector<render::Image>& frames) {
    FlickerRow row;
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

std::vector<FlickerRow> measureFlicker(const FlickerSettings& settings, const FlickerListener& listener) {
    render::Context context(settings.backend);
    std::vector<FlickerRow> rows;
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        const render::View view = damBreakView(settings.particles, style);
        for (const render::Quality quality :
             {render::Quality::draft, render::Quality::normal, render::Quality::final}) {
            render::Renderer renderer(context, settings.size, quality);
            std::vector<render::Image> frames;
            for (int frame = 0; frame < settings.frames; ++frame)
                frames.push_back(renderer.draw(shifted(view, settings, frame)));
            FlickerRow row = measured(frames);
            row.style = style;
            row.particles = settings.particles;
            row.size = settings.size;
            row.quality = quality;
            rows.push_back(row);
            listener(rows);
        }
    }
    return rows;
}

std::string flickerCsv(const std::vector<FlickerRow>& rows) {
    std::string csv = "style,particles,width,height,quality,change,jerk\n";
    for (const FlickerRow& row : rows)
        csv += fmt::format("{},{},{},{},{},{:.4g},{:.4g}\n", nameOf(row.style), row.particles, row.size.width,
                           row.size.height, nameOf(row.quality), row.change, row.jerk);
    return csv;
}

}  // namespace studies
