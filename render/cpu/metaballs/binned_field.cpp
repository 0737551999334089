// Balls from particles, and which tiles they reach.
#include "render/cpu/metaballs/binned_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <tbb/parallel_for.h>

namespace render {

namespace {

// Those that are nothing to look at left out.
std::vector<std::size_t> shownBalls(const Skinned& skin) {
    std::vector<std::size_t> shown;
    shown.reserve(skin.balls.size());
    for (std::size_t k = 0; k < skin.balls.size(); ++k)
        if (skin.view.particles[k].radius > 0.0F) shown.push_back(k);
    return shown;
}

std::vector<FieldBall> fieldBalls(const CameraFrame& frame, const Skinned& skin, std::span<const std::size_t> shown) {
    std::vector<FieldBall> balls(shown.size());
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t place) {
        const SkinBall& ball = skin.balls[shown[place]];
        const float reach = skin.view.field.reach * skin.view.particles[shown[place]].radius;
        const float peak = std::sqrt(ball.weight);
        balls[place] = {frame.toView(ball.center), reach, peak, std::sqrt(peak) / reach};
    });
    return balls;
}

}  // namespace

BinnedField binField(const CameraFrame& frame, const Skinned& skin) {
    BinnedField field;
    field.particles = shownBalls(skin);
    field.balls = fieldBalls(frame, skin, field.particles);
    std::vector<ViewSphere> reaches(field.balls.size());
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < field.balls.size(); ++k) {
        reaches[k] = {field.balls[k].center, field.balls[k].reach};
        smallest = std::min(smallest, field.balls[k].reach);
        sum += field.balls[k].reach;
    }
    // A dwarf among giants may not make every ray crawl: a tenth of the mean radius is as small as it gets.
    const double mean = sum / static_cast<double>(std::max<std::size_t>(field.balls.size(), 1));
    field.smallestRadius = std::max(smallest, static_cast<float>(0.1 * mean)) / skin.view.field.reach;
    field.tiles = binToTiles(frame, reaches, pixelBounds(frame, reaches));
    return field;
}

std::vector<BallLook> ballLooks(const Skinned& skin, const BinnedField& field) {
    std::vector<BallLook> looks(field.particles.size());
    tbb::parallel_for(std::size_t{0}, looks.size(), [&](std::size_t place) {
        const std::size_t k = field.particles[place];
        looks[place] = {skin.view.particles[k].color, skin.open.empty() ? kUnoccluded : skin.open[k]};
    });
    return looks;
}

FieldCast fieldCast(const CameraFrame& frame, const View& view, const BinnedField& field) {
    FieldCast cast;
    cast.frame = frame;
    cast.balls = field.balls;
    cast.tiles = &field.tiles;
    const float root = 1.0F - 1.0F / (view.field.reach * view.field.reach);
    cast.threshold = root * root;
    cast.step = 0.5F * field.smallestRadius;
    return cast;
}

}  // namespace render
