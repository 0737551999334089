// The balls of the oracle's metaball field: view.h's MetaballField, particle by particle. Called by the oracle's Scene.
#include <algorithm>
#include <cmath>

#include "studies/oracle/oracle.h"

namespace oracle {
namespace {

/// Moves and weights a ball and shortens its kernel, as its neighbors in a smooth skin make it.
/// @param ball  ball at its particle, with the kernel of a plain skin
/// @param own   the particle
void smoothen(Ball& ball, const Extent& own, const std::vector<Extent>& particles, const BallGrid& grid) {
    const double reach = ball.reach / own.radius;
    double density = 0.0;
    dvec3 pull(0.0);
    double end = ball.reach;
    for (const std::uint32_t k : grid.within(own.center, ball.reach)) {
        const Extent& other = particles[k];
        if (other.radius == 0.0) continue;
        const dvec3 off = other.center - own.center;
        const double sum = own.radius + other.radius;
        const double root = std::max(0.0, 1.0 - glm::dot(off, off) / std::pow(0.5 * reach * sum, 2.0));
        const double alike = std::max(0.0, 1.0 - 9.0 * std::pow((own.radius - other.radius) / sum, 2.0));
        density += root * root * alike;
        pull += root * root * alike * off;
        if (other.radius >= 0.5 * own.radius) continue;
        const double size = std::max(other.radius, double(render::kSkinLeastSize) * own.radius);
        const double beyond = (reach - 1.0) * (1.0 + 2.0 * size / own.radius) * size;
        end = std::min(end, std::max(own.radius + beyond, glm::length(off) - size));
    }
    const double steeper = (1.0 - 1.0 / (reach * reach)) / (1.0 - own.radius * own.radius / (end * end));
    ball = {own.center + double(render::kSkinPull) * pull / density, end, std::pow(density, -0.75) * steeper * steeper};
}

}  // namespace

std::vector<Ball> ballsOf(const render::View& view) {
    std::vector<Ball> balls;
    for (const render::Sphere& particle : view.particles)
        balls.push_back({dvec3(particle.center), double(view.field.reach) * double(particle.radius), 1.0});
    if (view.field.skin == render::Skin::plain || view.style == render::Style::spheres) return balls;
    std::vector<Extent> extents;
    // Particles influence a ball if they lie, at least in part, within the longest kernel that it may have.
    for (const render::Sphere& particle : view.particles)
        extents.push_back({dvec3(particle.center), double(particle.radius)});
    const BallGrid grid(extents);
    for (std::size_t k = 0; k < balls.size(); ++k)
        if (extents[k].radius > 0.0) smoothen(balls[k], extents[k], extents, grid);
    return balls;
}

}  // namespace oracle
