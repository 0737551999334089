// The observable of particles that are shot at obstacles: how many of them tunneled through one.
#include <algorithm>
#include <cmath>
#include <variant>

#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Vec3;

/// The straight path of a particle: the segment from its first position in a run to its last, m.
struct Path {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::Zero();
};

bool isInside(const Vec3& point, const Vec3& minimum, const Vec3& maximum) {
    return (point.array() > minimum.array()).all() && (point.array() < maximum.array()).all();
}

/// Whether a straight path crosses an axis-aligned box: whether its parts between the faces of each axis overlap.
bool crossesBox(const Path& path, const Vec3& minimum, const Vec3& maximum) {
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double length = path.to[axis] - path.from[axis];
        if (length == 0.0) {
            if (path.from[axis] <= minimum[axis] || path.from[axis] >= maximum[axis]) return false;
            continue;
        }
        const double low = (minimum[axis] - path.from[axis]) / length;
        const double high = (maximum[axis] - path.from[axis]) / length;
        enter = std::max(enter, std::min(low, high));
        leave = std::min(leave, std::max(low, high));
    }
    return enter < leave;
}

bool crossesSphere(const Path& path, const Vec3& center, double radius) {
    const Vec3 displacement = path.to - path.from;
    const double lengthSq = displacement.squaredNorm();
    const double closest = lengthSq > 0.0 ? std::clamp(displacement.dot(center - path.from) / lengthSq, 0.0, 1.0) : 0.0;
    return (path.from + closest * displacement - center).norm() < radius;
}

// There is a function for each shape of obstacle: whether a particle is on the wrong side at the end of its path. A
// particle in contact may be behind the face by `depth` (m), because the centers of the face's repulsors are that far
// behind the face.

bool isOnWrongSide(const engine::Plane& plane, const Path& path, double depth) {
    return plane.normal.dot(path.to - plane.point) < -depth;
}

bool isOnWrongSide(const engine::Container& container, const Path& path, double depth) {
    return !isInside(path.to, container.minimum - Vec3::Constant(depth), container.maximum + Vec3::Constant(depth));
}

/// A particle that starts inside a solid must be outside at the end; one that starts outside must neither enter the
/// solid nor cross it.
bool isOnWrongSide(const engine::Box& box, const Path& path, double) {
    if (isInside(path.from, box.minimum, box.maximum)) return isInside(path.to, box.minimum, box.maximum);
    return crossesBox(path, box.minimum, box.maximum);
}

bool isOnWrongSide(const engine::Sphere& sphere, const Path& path, double) {
    if ((path.from - sphere.center).norm() < sphere.radius) return (path.to - sphere.center).norm() < sphere.radius;
    return crossesSphere(path, sphere.center, sphere.radius);
}

template <class Distances>
bool isOnWrongSide(const engine::DistanceSolid<Distances>& solid, const Path& path, double) {
    return solid.at(path.from).value > 0.0 && solid.at(path.to).value < 0.0;
}

}  // namespace

/// Observable: number of particles on the wrong side of an obstacle at the end of a run: behind the repulsors of a
/// plane or container, inside a solid, or beyond one. The first and last position of a particle that bounced once off a
/// convex solid are both on the free side of the tangent plane at the contact, so the segment between them misses the
/// solid; the segment of a particle that went through crosses it. This holds without gravity and with one solid in the
/// path of each particle.
double tunnelingCount(const ObservableInput& input) {
    const engine::Particles& first = input.run.frames.front();
    const engine::Particles& last = input.run.frames.back();
    const double depth = input.scene.setup.obstacles.law.radius;
    int count = 0;
    for (std::size_t p = 0; p < first.count(); ++p) {
        const Path path{first.position[p], last.position[p]};
        bool isWrong = false;
        for (const engine::Obstacle& obstacle : input.scene.setup.obstacles.shapes)
            isWrong =
                isWrong || std::visit([&](const auto& shape) { return isOnWrongSide(shape, path, depth); }, obstacle);
        if (isWrong) ++count;
    }
    return count;
}

}  // namespace studies
