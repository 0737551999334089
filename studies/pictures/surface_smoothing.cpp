// Compares plain and smooth metaball surfaces: the volume inside by samples of the field along vertical lines, the
// bumps by the normals of a level surface, and the time by drawing. See SmoothingRow in pictures.h.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

#include "render/renderer.h"
#include "studies/common/timing.h"
#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/level_pool.h"
#include "studies/pictures/pictures.h"

namespace studies {
namespace {

/// An axis-aligned box around the reaches of all metaballs, m.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::max()};
    glm::dvec3 high{std::numeric_limits<double>::lowest()};
};

Box boxAround(const oracle::Scene& scene) {
    Box box;
    for (const oracle::Ball& ball : scene.balls) {
        box.low = glm::min(box.low, ball.center - ball.reach);
        box.high = glm::max(box.high, ball.center + ball.reach);
    }
    return box;
}

/// Number of sample points inside the metaball surface along a vertical line.
/// @param step  distance of neighboring points, m
long insideAlong(const oracle::Scene& scene, const Box& box, double x, double z, double step) {
    const oracle::Indices near = scene.ballsAlong({{x, box.high.y, z}, {0.0, -1.0, 0.0}});
    const double threshold = oracle::fieldThreshold(scene.view);
    long inside = 0;
    if (near.empty()) return inside;
    for (double y = box.low.y + 0.5 * step; y < box.high.y; y += step)
        inside += oracle::fieldAt(scene, near, {x, y, z}) >= threshold ? 1 : 0;
    return inside;
}

/// RMS tilt from the vertical of the normals of a surface as seen from above, degrees.
double bumpsOf(render::Renderer& renderer, const render::View& pool) {
    double squares = 0.0;
    long hits = 0;
    for (const render::VisiblePoint& point : renderer.visiblePoints(pool)) {
        if (point.depth < 0.0F) continue;
        const double tilt = std::acos(std::clamp(double(point.normal.y), -1.0, 1.0));
        squares += tilt * tilt;
        ++hits;
    }
    return std::sqrt(squares / static_cast<double>(std::max(hits, 1L))) * 180.0 / std::numbers::pi;
}

/// Measures the shape of the metaball surface, which does not depend on the number of particles.
SmoothingRow shapeOf(const SmoothingSettings& settings, render::Skin skin) {
    SmoothingRow row;
    row.skin = skin;
    render::View view = damBreakView(1000, render::Style::metaballs);
    view.field.skin = skin;
    const render::View pool = levelPool(view);
    row.volume = fieldVolume(pool, settings.spacing) / static_cast<double>(pool.particles.size());
    view.particles = {{glm::vec3(0.0F), 1.0F, glm::vec3(0.8F)}};  // a single particle with a radius of 1 m
    row.lone = fieldVolume(view, 0.2 * settings.spacing) / (4.0 / 3.0 * std::numbers::pi);
    // At final quality a ray is cast for every pixel; at lower qualities some normals are interpolated.
    render::Renderer renderer(settings.size, render::Quality::final);
    row.bumps = bumpsOf(renderer, pool);
    return row;
}

/// Median time to draw a frame of the dam break at normal quality, s.
double secondsAFrame(const SmoothingSettings& settings, std::size_t particles, render::Skin skin) {
    render::View view = damBreakView(particles, render::Style::metaballs);
    view.field.skin = skin;
    render::Renderer renderer(settings.size, render::Quality::normal);
    renderer.draw(view);  // drawing the first frame allocates memory
    std::vector<double> seconds;
    for (const render::View& frame : framesOf(view, settings.frames))
        seconds.push_back(secondsOf([&] { renderer.draw(frame); }));
    return median(seconds);
}

}  // namespace

double fieldVolume(const render::View& view, double spacing) {
    const oracle::Scene scene(view);
    const Box box = boxAround(scene);
    const double step = spacing * oracle::meanRadius(view);
    const auto along = [&](int axis) { return static_cast<std::size_t>((box.high[axis] - box.low[axis]) / step) + 1; };
    std::vector<long> inside(along(0), 0);
    tbb::parallel_for(std::size_t{0}, inside.size(), [&](std::size_t column) {
        const double x = box.low.x + (static_cast<double>(column) + 0.5) * step;
        for (std::size_t row = 0; row < along(2); ++row)
            inside[column] += insideAlong(scene, box, x, box.low.z + (static_cast<double>(row) + 0.5) * step, step);
    });
    long sum = 0;
    for (const long count : inside) sum += count;
    return static_cast<double>(sum) * step * step * step;
}

std::vector<SmoothingRow> measureSmoothing(const SmoothingSettings& settings,
                                           const RowsListener<SmoothingRow>& listener) {
    std::vector<SmoothingRow> rows;
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic}) {
        SmoothingRow row = shapeOf(settings, skin);
        for (const std::size_t particles : settings.particles) {
            row.particles = particles;
            row.draw = secondsAFrame(settings, particles, skin);
            rows.push_back(row);
            listener(rows);
        }
    }
    return rows;
}

}  // namespace studies
