// The balls of the oracle's metaball field: view.h's MetaballField, particle by particle. Called by the oracle's Scene.
#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "studies/oracle/oracle.h"

namespace oracle {
namespace {

/// k of view.h between two particles; K with twice the reach.
double influenceOf(const Extent& own, const Extent& other, double reach) {
    const dvec3 off = other.center - own.center;
    const double sum = own.radius + other.radius;
    const double root = std::max(0.0, 1.0 - glm::dot(off, off) / std::pow(0.5 * reach * sum, 2.0));
    const double alike = std::max(0.0, 1.0 - 9.0 * std::pow((own.radius - other.radius) / sum, 2.0));
    return other.radius > 0.0 ? root * root * alike : 0.0;
}

/// m and C of view.h's anisotropic skin.
struct Neighbors {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

Neighbors neighborsOf(const Extent& own, double reach, const std::vector<Extent>& particles, const BallGrid& grid) {
    const auto forEach = [&](const auto& visit) {
        for (const std::uint32_t k : grid.within(own.center, 2.0 * reach * own.radius)) {
            const dvec3 off = particles[k].center - own.center;
            visit(influenceOf(own, particles[k], 2.0 * reach), Eigen::Vector3d(off.x, off.y, off.z));
        }
    };
    Neighbors found;
    double sum = 0.0;
    forEach([&](double weight, const Eigen::Vector3d& off) {
        sum += weight;
        found.mean += weight * off;
    });
    found.mean /= sum;
    const double support = 2.0 * reach * own.radius;
    found.covariance *= double(render::kSkinRoundness) * support * support / 9.0;
    forEach([&](double weight, const Eigen::Vector3d& off) {
        found.covariance += weight * (off - found.mean) * (off - found.mean).transpose();
    });
    found.covariance /= found.covariance.trace() / 3.0;
    return found;
}

/// Stretches a ball of a smooth skin, and puts it where an anisotropic skin has it.
/// @param neighbors  of all particles
void stretch(Ball& ball, std::size_t index, double reach, const std::vector<Extent>& particles, const BallGrid& grid,
             const std::vector<Neighbors>& neighbors) {
    const Extent& own = particles[index];
    double density = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t k : grid.within(own.center, reach * own.radius)) {
        const double weight = influenceOf(own, particles[k], reach);
        density += weight;
        sum += weight * neighbors[k].mean;
    }
    const Eigen::Vector3d shift = neighbors[index].mean - sum / density;
    ball.center = own.center + dvec3(shift.x(), shift.y(), shift.z());
    const double room = (ball.reach - own.radius) / ((reach - 1.0) * own.radius);
    const double s = double(render::kSkinStretch) * room * room;
    // The axes of the ellipsoid are those of C, and as long as R times the eigenvalues of D over the cube root of their
    // product.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(neighbors[index].covariance);
    const Eigen::Array3d values = 1.0 - s + s * axes.eigenvalues().array();
    const Eigen::Array3d lengths = ball.reach * values / std::cbrt(values.prod());
    const Eigen::Matrix3d form =
        axes.eigenvectors() * lengths.square().inverse().matrix().asDiagonal() * axes.eigenvectors().transpose();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) ball.form[column][row] = form(row, column);
    ball.reach = lengths.maxCoeff();
}

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
        const double influence = influenceOf(own, other, reach);
        density += influence;
        pull += influence * off;
        if (other.radius >= 0.5 * own.radius) continue;
        const double size = std::max(other.radius, double(render::kSkinLeastSize) * own.radius);
        const double beyond = (reach - 1.0) * (1.0 + 2.0 * size / own.radius) * size;
        end = std::min(end, std::max(own.radius + beyond, glm::length(off) - size));
    }
    const double steeper = (1.0 - 1.0 / (reach * reach)) / (1.0 - own.radius * own.radius / (end * end));
    ball = {own.center + double(render::kSkinPull) * pull / density, end, std::pow(density, -0.75) * steeper * steeper,
            glm::dmat3(1.0 / (end * end))};
}

}  // namespace

std::vector<Ball> ballsOf(const render::View& view) {
    std::vector<Ball> balls;
    const double reach = double(view.field.reach);
    for (const render::Sphere& particle : view.particles)
        balls.push_back({dvec3(particle.center), reach * double(particle.radius), 1.0,
                         glm::dmat3(std::pow(reach * double(particle.radius), -2.0))});
    if (view.field.skin == render::Skin::plain || view.style == render::Style::spheres) return balls;
    std::vector<Extent> extents;
    // Particles influence a ball if they lie, at least in part, within the longest kernel that it may have.
    for (const render::Sphere& particle : view.particles)
        extents.push_back({dvec3(particle.center), double(particle.radius)});
    const BallGrid grid(extents);
    for (std::size_t k = 0; k < balls.size(); ++k)
        if (extents[k].radius > 0.0) smoothen(balls[k], extents[k], extents, grid);
    if (view.field.skin != render::Skin::anisotropic) return balls;
    std::vector<Neighbors> neighbors(balls.size());
    for (std::size_t k = 0; k < balls.size(); ++k)
        if (extents[k].radius > 0.0) neighbors[k] = neighborsOf(extents[k], reach, extents, grid);
    for (std::size_t k = 0; k < balls.size(); ++k)
        if (extents[k].radius > 0.0) stretch(balls[k], k, reach, extents, grid, neighbors);
    return balls;
}

}  // namespace oracle
