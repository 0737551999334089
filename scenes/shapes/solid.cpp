#include "scenes/shapes/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scenes {

using engine::Vec3;

namespace {

/// The vector in the coordinates that a rotation turns into the scene's.
Vec3 turnedBack(const engine::Matrix3& rotation, const Vec3& vector) {
    return {engine::dot(rotation.col(0), vector), engine::dot(rotation.col(1), vector),
            engine::dot(rotation.col(2), vector)};
}

std::vector<Vec3> cornersOf(const Vec3& low, const Vec3& high) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                             (k & 4) != 0 ? high.z() : low.z());
    return corners;
}

}  // namespace

double Cuboid::distance(const Vec3& point) const {
    const Vec3 beyond = point.cwiseAbs() - halfSize;
    return std::sqrt(engine::squaredLength(beyond.cwiseMax(0.0))) + std::min(beyond.maxCoeff(), 0.0);
}

double Silhouette::reach(const Vec3& direction) const {
    const double across = std::sqrt(direction.x() * direction.x() + direction.z() * direction.z());
    double most = -std::numeric_limits<double>::infinity();
    for (const engine::ProfilePoint& circle : circles)
        most = std::max(most, circle.radius * across + circle.height * direction.y());
    for (const Vec3& point : points) most = std::max(most, engine::dot(point, direction));
    return most + margin;
}

double Solid::distance(const Vec3& point) const {
    const Vec3 local = turnedBack(placement_.rotation, point - placement_.center);
    const double distance = std::visit(
        [&](const auto& shape) {
            if constexpr (requires { shape.at(local); })
                return shape.at(local).value;
            else
                return shape.distance(local);
        },
        shape_);
    return thickness_ > 0.0 ? std::max(distance, -distance - thickness_) : distance;
}

double Solid::reach(const Vec3& direction) const {
    return silhouette_.reach(turnedBack(placement_.rotation, direction)) + engine::dot(placement_.center, direction);
}

engine::BoundingBox Solid::bounds() const {
    engine::BoundingBox box;
    for (int axis = 0; axis < 3; ++axis) {
        box.high[axis] = reach(Vec3::Unit(axis));
        box.low[axis] = -reach(-Vec3::Unit(axis));
    }
    return box;
}

Solid ballSolid(double radius, const Placement& placement, double thickness) {
    return revolutionSolid({{0.0, 0.0}}, false, radius, placement, thickness);
}

Solid cuboidSolid(const Vec3& size, const Placement& placement, double thickness) {
    const Vec3 half = 0.5 * size;
    return {Cuboid{half}, {{}, cornersOf(-half, half), 0.0}, placement, thickness};
}

Solid revolutionSolid(const std::vector<engine::ProfilePoint>& profile, bool isClosed, double halfThickness,
                      const Placement& placement, double hollowThickness) {
    return {
        engine::Revolution(profile, isClosed, halfThickness), {profile, {}, halfThickness}, placement, hollowThickness};
}

Solid pointSolid(std::vector<Vec3> points, const Placement& placement) {
    return {Cuboid{}, {{}, std::move(points), 0.0}, placement, 0.0};
}

Solid extrusionSolid(Extrusion extrusion, const Placement& placement, double thickness) {
    const engine::BoundingBox box = extrusion.bounds();
    return {std::move(extrusion), {{}, cornersOf(box.low, box.high), 0.0}, placement, thickness};
}

double estimatedVolume(const Solid& solid) {
    constexpr int kSamples = 48;
    const engine::BoundingBox box = solid.bounds();
    const Vec3 step = (box.high - box.low) / kSamples;
    std::size_t inside = 0;
    for (int z = 0; z < kSamples; ++z)
        for (int y = 0; y < kSamples; ++y)
            for (int x = 0; x < kSamples; ++x)
                if (solid.distance(box.low + step.cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5))) <= 0.0) ++inside;
    return static_cast<double>(inside) * step.x() * step.y() * step.z();
}

}  // namespace scenes
