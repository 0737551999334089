// Observables of shots at obstacles: whether one passed.
#include <algorithm>
#include <cmath>
#include <variant>

#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Vec3;

/// The straight way of a particle from its first place to its last.
struct Flight {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::Zero();
};

bool isInside(const Vec3& point, const Vec3& minimum, const Vec3& maximum) {
    return (point.array() > minimum.array()).all() && (point.array() < maximum.array()).all();
}

/// Whether a straight way meets an axis-aligned box: by the interval of its parameter that lies between each two faces.
bool meetsBox(const Flight& flight, const Vec3& minimum, const Vec3& maximum) {
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = flight.to[axis] - flight.from[axis];
        if (way == 0.0) {
            if (flight.from[axis] <= minimum[axis] || flight.from[axis] >= maximum[axis]) return false;
            continue;
        }
        const double low = (minimum[axis] - flight.from[axis]) / way;
        const double high = (maximum[axis] - flight.from[axis]) / way;
        enter = std::max(enter, std::min(low, high));
        leave = std::min(leave, std::max(low, high));
    }
    return enter < leave;
}

bool meetsSphere(const Flight& flight, const Vec3& center, double radius) {
    const Vec3 way = flight.to - flight.from;
    const double lengthSq = way.squaredNorm();
    const double place = lengthSq > 0.0 ? std::clamp(way.dot(center - flight.from) / lengthSq, 0.0, 1.0) : 0.0;
    return (flight.from + place * way - center).norm() < radius;
}

/// depth: of the repulsor's center under the face, m. A particle in contact may be that far under it.
bool isThrough(const engine::Plane& plane, const Flight& flight, double depth) {
    return plane.normal.dot(flight.to - plane.point) < -depth;
}

bool isThrough(const engine::Container& container, const Flight& flight, double depth) {
    return !isInside(flight.to, container.minimum - Vec3::Constant(depth), container.maximum + Vec3::Constant(depth));
}

/// A shot from inside has to come out; one from outside must not get in.
bool isThrough(const engine::Box& box, const Flight& flight, double) {
    if (isInside(flight.from, box.minimum, box.maximum)) return isInside(flight.to, box.minimum, box.maximum);
    return meetsBox(flight, box.minimum, box.maximum);
}

bool isThrough(const engine::Sphere& sphere, const Flight& flight, double) {
    if ((flight.from - sphere.center).norm() < sphere.radius) return (flight.to - sphere.center).norm() < sphere.radius;
    return meetsSphere(flight, sphere.center, sphere.radius);
}

}  // namespace

/// Shots that are on the wrong side of an obstacle at the end: behind a plane's repulsor, or that of a container,
/// inside a solid, or beyond one. A shot that bounced once off a convex solid has its first and last place on the free
/// side of the plane through the point where it touched, so the straight line between them misses the solid; one that
/// went through crosses it. This holds without gravity and with one solid in the way of each shot.
double tunnelingCount(const ObservableInput& trial) {
    const engine::Particles& first = trial.run.frames.front();
    const engine::Particles& last = trial.run.frames.back();
    const double depth = trial.scene.setup.obstacles.law.radius;
    int count = 0;
    for (std::size_t p = 0; p < first.count(); ++p) {
        const Flight flight{first.position[p], last.position[p]};
        bool through = false;
        for (const engine::Obstacle& obstacle : trial.scene.setup.obstacles.shapes)
            through =
                through || std::visit([&](const auto& shape) { return isThrough(shape, flight, depth); }, obstacle);
        if (through) ++count;
    }
    return count;
}

}  // namespace studies
