// The field along vertical lines for the volume, the normals of a level surface for the bumps.
#include "studies/pictures/surface_smoothing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

#include "render/renderer.h"
#include "studies/common/timing.h"
#include "studies/oracle/oracle.h"
#include "studies/pictures/dam_break_view.h"

namespace studies {
namespace {

double meanRadius(const render::View& view) {
    double sum = 0.0;
    for (const render::Sphere& particle : view.particles) sum += double(particle.radius);
    return sum / static_cast<double>(view.particles.size());
}

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

bool isInside(const oracle::Scene& scene, const oracle::Indices& near, const glm::dvec3& place) {
    double field = 0.0;
    for (const std::uint32_t index : near) {
        const oracle::Ball& ball = scene.balls[index];
        const glm::dvec3 off = place - ball.center;
        const double root = std::max(0.0, 1.0 - glm::dot(off, off) / (ball.reach * ball.reach));
        field += ball.weight * root * root;
    }
    return field >= oracle::fieldThreshold(scene.view);
}

/// Samples inside along a vertical line.
long insideAlong(const oracle::Scene& scene, const Box& box, double x, double z, double step) {
    const oracle::Indices near = scene.crowd.along({{x, box.high.y, z}, {0.0, -1.0, 0.0}});
    long inside = 0;
    if (near.empty()) return inside;
    for (double y = box.low.y + 0.5 * step; y < box.high.y; y += step)
        inside += isInside(scene, near, {x, y, z}) ? 1 : 0;
    return inside;
}

constexpr int kPoolSide = 24;  // particles
constexpr int kPoolDepth = 6;
constexpr double kPoolVolume = kPoolSide * kPoolSide * kPoolDepth;

/// A level pool at a spacing of 1, shaken; radius and spacing as where the paper's material settles, at .76 diameters.
/// Seen from above the middle.
render::View levelPool(const render::View& cloud) {
    constexpr double kShake = 0.12;
    render::View view = cloud;
    view.particles.clear();
    view.ground.reset();
    view.camera.projection = render::Projection::orthographic;
    view.camera.eye = {0.0F, 10.0F, 0.0F};
    view.camera.up = {0.0F, 0.0F, -1.0F};
    view.camera.target = glm::vec3(0.0F);
    view.camera.halfHeight = 3.0F;
    // Multiples of irrational numbers, modulo 1: spread evenly, and not in step with the lattice.
    const auto shaken = [](int k, double by) { return kShake * (2.0 * (k * by - std::floor(k * by)) - 1.0); };
    for (int k = 0; k < kPoolSide * kPoolSide * kPoolDepth; ++k) {
        const glm::dvec3 lattice(k % kPoolSide - 0.5 * kPoolSide, -(k / kPoolSide / kPoolSide),
                                 k / kPoolSide % kPoolSide - 0.5 * kPoolSide);
        const glm::dvec3 off(shaken(k, std::numbers::sqrt2), shaken(k, std::numbers::sqrt3),
                             shaken(k, std::numbers::pi));
        view.particles.push_back({glm::vec3(lattice + off), 0.658F, glm::vec3(0.8F)});
    }
    return view;
}

/// RMS tilt of the normals of what is seen from above, degrees.
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

render::View loneView(const render::View& cloud) {
    render::View view = cloud;
    view.particles = {{glm::vec3(0.0F), 1.0F, glm::vec3(0.8F)}};
    return view;
}

/// What does not depend on the number of particles.
SmoothingRow shapeOf(const SmoothingSettings& settings, render::Context& context, render::Skin skin) {
    SmoothingRow row;
    row.skin = skin;
    render::View view = damBreakView(1000, render::Style::metaballs);
    view.field.skin = skin;
    const render::View pool = levelPool(view);
    row.volume = fieldVolume(pool, settings.spacing) / kPoolVolume;
    const render::View lone = loneView(view);
    row.lone = fieldVolume(lone, 0.2 * settings.spacing) / (4.0 / 3.0 * std::numbers::pi);
    // All rays cast: none of the normals is a mean of its neighbors'.
    render::Renderer renderer(context, settings.size, render::Quality::final);
    row.bumps = bumpsOf(renderer, pool);
    return row;
}

double secondsAFrame(const SmoothingSettings& settings, render::Context& context, std::size_t particles,
                     render::Skin skin) {
    render::View view = damBreakView(particles, render::Style::metaballs);
    view.field.skin = skin;
    render::Renderer renderer(context, settings.size, render::Quality::normal);
    renderer.draw(view);  // touches the memory
    std::vector<double> seconds;
    for (const render::View& frame : framesOf(view, settings.frames))
        seconds.push_back(secondsOf([&] { renderer.draw(frame); }, 1));
    return median(seconds);
}

}  // namespace

const char* nameOf(render::Skin skin) {
    return skin == render::Skin::plain ? "plain" : "smooth";
}

double fieldVolume(const render::View& view, double spacing) {
    const oracle::Scene scene(view);
    const Box box = boxAround(scene);
    const double step = spacing * meanRadius(view);
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

std::vector<SmoothingRow> measureSmoothing(const SmoothingSettings& settings, const SmoothingListener& listener) {
    render::Context context(settings.backend);
    std::vector<SmoothingRow> rows;
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth}) {
        SmoothingRow row = shapeOf(settings, context, skin);
        for (const std::size_t particles : settings.particles) {
            row.particles = particles;
            row.draw = secondsAFrame(settings, context, particles, skin);
            rows.push_back(row);
            listener(rows);
        }
    }
    return rows;
}

std::string smoothingCsv(const std::vector<SmoothingRow>& rows) {
    std::string csv = "skin,particles,draw_ms,volume,lone_volume,bumps_degrees\n";
    for (const SmoothingRow& row : rows)
        csv += fmt::format("{},{},{:.4g},{:.4f},{:.4f},{:.3f}\n", nameOf(row.skin), row.particles, 1e3 * row.draw,
                           row.volume, row.lone, row.bumps);
    return csv;
}

}  // namespace studies
