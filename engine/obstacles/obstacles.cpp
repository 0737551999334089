// The forces of obstacles on a particle, as in the paper, and the energy of these forces.
#include "engine/obstacles/obstacles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/obstacles/contact.h"

namespace engine {
namespace {

std::optional<BoundingBox> boundsOfShape(const Plane& /*plane*/) {
    return std::nullopt;
}

std::optional<BoundingBox> boundsOfShape(const Container& walls) {
    return BoundingBox{walls.minimum, walls.maximum};
}

std::optional<BoundingBox> boundsOfShape(const Box& box) {
    return BoundingBox{box.minimum, box.maximum};
}

std::optional<BoundingBox> boundsOfShape(const Sphere& sphere) {
    const Vec3 half = Vec3::Constant(sphere.radius);
    return BoundingBox{sphere.center - half, sphere.center + half};
}

template <class Distances>
std::optional<BoundingBox> boundsOfShape(const DistanceSolid<Distances>& solid) {
    return solid.bounds;
}

template <class Distances>
DistanceSolid<Distances> solidOf(Distances distances, double thickness, const Vec3& origin) {
    const BoundingBox bounds = distances.bounds();
    return {std::make_shared<const Distances>(std::move(distances)),
            origin,
            {bounds.low + origin, bounds.high + origin},
            thickness};
}

/// The largest distance of a point of a shape from a point (m); infinite for a plane.
double extentOf(const Obstacle& shape, const Vec3& from) {
    const std::optional<BoundingBox> bounds = boundsOf(shape);
    if (!bounds) return std::numeric_limits<double>::infinity();
    return std::sqrt(squaredLength((from - bounds->low).cwiseAbs().cwiseMax((bounds->high - from).cwiseAbs())));
}

/// What contains an obstacle, given by its index, throughout the step whose places are kept. No point of it is farther
/// from where it is at the start than its fastest point goes.
BoundingBox sweptBounds(const Obstacles& obstacles, std::size_t obstacle) {
    const Motion& motion = obstacles.motions[obstacle];
    const Obstacle& shape = obstacles.shapes[obstacle];
    const bool isEndless = std::holds_alternative<Plane>(shape) || std::holds_alternative<Container>(shape);
    if (isEndless || motion.isIdentity()) return BoundingBox::unbounded();
    const auto& [start, end] = obstacles.kept.ends;
    const double fastest = fastestBetween(motion, start.time, end.time, extentOf(shape, motion.pivot));
    const Vec3 margin = Vec3::Constant(fastest * (end.time - start.time));
    const BoundingBox bounds = boundsIn(start.poses[obstacle], *boundsOf(shape));
    return {bounds.low - margin, bounds.high + margin};
}

}  // namespace

RevolutionSolid revolutionSolid(Revolution revolution, const Vec3& origin) {
    const double thickness = revolution.thickness();
    return solidOf(std::move(revolution), thickness, origin);
}

MeshSolid meshSolid(DistanceGrid grid, const Vec3& origin) {
    // Thinner walls are not on the grid.
    const double thickness = 2.0 * grid.bricks().voxel;
    return solidOf(std::move(grid), thickness, origin);
}

std::size_t contactGrain(const Obstacles& obstacles) {
    constexpr std::size_t kContactGrain =
        256;  // fewest particles a thread; chosen: the contacts of one take 0.1 to 10 microseconds
    return obstacles.shapes.empty() ? kParticleGrain : kContactGrain;
}

Rebound reboundWith(double restitution) {
    // Bisection of e(zeta) = exp(-pi zeta / sqrt(1 - zeta^2)), which has the same bits on every machine.
    double low = 0.0;
    double high = 1.0;
    constexpr int kHalvings = 60;  // more than a double has bits
    for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        const double exponent = std::numbers::pi * middle / std::sqrt(1.0 - middle * middle);
        (expNegative(exponent) > restitution ? low : high) = middle;
    }
    return {restitution, restitution > 0.0 ? low : 1.0, false};
}

std::optional<BoundingBox> boundsOf(const Obstacle& obstacle) {
    return std::visit([](const auto& shape) { return boundsOfShape(shape); }, obstacle);
}

BoundingBox boundsIn(const Pose& pose, const BoundingBox& box) {
    BoundingBox bounds = BoundingBox::empty();
    for (int corner = 0; corner < 8; ++corner) {
        const auto chosen = [&](int axis) { return (corner >> axis & 1) != 0 ? box.high[axis] : box.low[axis]; };
        const Vec3 point = pose.toScene({chosen(0), chosen(1), chosen(2)});
        bounds.include({point, point});
    }
    return bounds;
}

bool areInMotion(const Obstacles& obstacles) {
    return std::ranges::any_of(obstacles.motions, [](const Motion& motion) { return !motion.isAtRest(); });
}

void recordInMotion(Obstacles& obstacles) {
    if (!areInMotion(obstacles)) return;
    obstacles.areRecorded.resize(obstacles.shapes.size());
    for (std::size_t k = 0; k < obstacles.motions.size(); ++k)
        if (!obstacles.motions[k].isAtRest()) obstacles.areRecorded[k] = true;
}

void place(Obstacles& obstacles, double from, double to) {
    if (obstacles.motions.empty()) return;
    auto& [ends, swept, inMotion] = obstacles.kept;
    if (ends[0].time == from && ends[1].time == to) return;
    // The end of a step mostly is the start of the next.
    if (ends[1].time == from) std::swap(ends[0], ends[1]);
    const std::array times = {from, to};
    for (std::size_t k = 0; k < times.size(); ++k) {
        if (ends[k].time == times[k]) continue;
        ends[k].time = times[k];
        ends[k].poses.clear();
        for (const Motion& motion : obstacles.motions) ends[k].poses.push_back(poseAt(motion, times[k]));
    }
    swept.clear();
    for (std::size_t k = 0; k < obstacles.motions.size(); ++k) swept.push_back(sweptBounds(obstacles, k));
    inMotion.clear();
    for (std::uint32_t k = 0; k < obstacles.motions.size(); ++k)
        if (!obstacles.motions[k].isAtRest()) inMotion.push_back(k);
}

Vec3 pivotAt(const Obstacles& obstacles, std::size_t obstacle, double time) {
    if (!obstacles.motions.empty()) return poseOf(obstacles, obstacle, time).position;
    const std::optional<BoundingBox> bounds = boundsOf(obstacles.shapes[obstacle]);
    return bounds ? bounds->middle() : Vec3::Zero();
}

double fastestSurface(const Obstacles& obstacles, double from, double to) {
    double fastest = 0.0;
    for (std::size_t k = 0; k < obstacles.motions.size(); ++k) {
        const Motion& motion = obstacles.motions[k];
        if (motion.isAtRest()) continue;
        fastest = std::max(fastest, fastestBetween(motion, from, to, extentOf(obstacles.shapes[k], motion.pivot)));
    }
    return fastest;
}

ObstacleIndex indexOf(const Obstacles& obstacles) {
    // Fewest boxes and spheres for which the tree is used. Measured with `globular simulate` on the scenes fountain and
    // mud, which have five: they take a twentieth less time.
    constexpr std::size_t kFewest = 4;
    if (obstacles.wall == WallLaw::paper) return {};
    const std::vector<Obstacle>& shapes = obstacles.shapes;
    ObstacleIndex index;
    index.isWetted = std::ranges::any_of(obstacles.surfaces, [](const WallSurface& s) { return s.wetting > 0.0; });
    std::vector<BoundingBox> boxes;
    for (std::uint32_t k = 0; k < shapes.size(); ++k) {
        const bool isEndless = std::holds_alternative<Plane>(shapes[k]) || std::holds_alternative<Container>(shapes[k]);
        const bool isIndexed = !isEndless && (obstacles.motions.empty() || obstacles.motions[k].isAtRest());
        (isIndexed ? index.obstacleOf : index.unbounded).push_back(k);
        if (!isIndexed) continue;
        const BoundingBox bounds = *boundsOf(shapes[k]);
        boxes.push_back(isPlaced(obstacles, k) ? boundsIn(poseAt(obstacles.motions[k], 0.0), bounds) : bounds);
    }
    if (boxes.size() < kFewest) return {.solids = {}, .obstacleOf = {}, .unbounded = {}, .isWetted = index.isWetted};
    index.solids = BoundingBoxTree(boxes);
    return index;
}

ContactSums sumContacts(const Obstacles& obstacles, const Probe& probe, ContactLoads* loads, double seconds) {
    ContactSums sums;
    forEachTouched(obstacles, probe.position, probe.time, probe.radius, [&](const Surface& surface) {
        const Contact contact = contactWith(surface, obstacles, probe);
        const Vec3 before = sums.force;
        addForce(surface, contact, probe, sums.force);
        sums.energy += contactEnergy(contact);
        if (loads != nullptr) recordLoad(surface, seconds * (sums.force - before), obstacles, probe, *loads);
    });
    return sums;
}

}  // namespace engine
