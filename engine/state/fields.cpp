// Accelerations, drag and potentials of fields.
#include "engine/state/fields.h"

#include <algorithm>
#include <cmath>

#include "engine/core/exp_negative.h"

namespace engine {
namespace {

/// Distance from the center of a point field with the softening added in quadrature, m.
double softDistance(const PointField& field, const Vec3& away) {
    return std::sqrt(squaredLength(away) + field.softening * field.softening);
}

Vec3 accelerationOf(const PointField& field, const Vec3& position) {
    const Vec3 away = position - field.center;
    const double distance = softDistance(field, away);
    return -(field.strength / (distance * distance * distance)) * away;
}

double potentialOf(const UniformField& field, const Vec3& position) {
    return -dot(field.acceleration, position);
}

double potentialOf(const PointField& field, const Vec3& position) {
    return -field.strength / softDistance(field, position - field.center);
}

double potentialOf(const FlowField&, const Vec3&) {
    return 0.0;
}

}  // namespace

FieldKick::FieldKick(const Field& field, double from, double to)
    : field_(&field), seconds_(std::min(to, field.until) - std::max(from, field.start)) {
    if (const auto* flow = std::get_if<FlowField>(&field.law); flow != nullptr && exists())
        decay_ = expNegative(flow->rate * seconds_);
}

Vec3 FieldKick::velocityAfter(const Vec3& position, const Vec3& velocity) const {
    if (field_->box && !field_->box->contains(position)) return velocity;
    if (const auto* uniform = std::get_if<UniformField>(&field_->law))
        return velocity + seconds_ * uniform->acceleration;
    if (const auto* point = std::get_if<PointField>(&field_->law))
        return velocity + seconds_ * accelerationOf(*point, position);
    const Vec3 flow = std::get<FlowField>(field_->law).velocityAt(position);
    return flow + decay_ * (velocity - flow);
}

double largestAcceleration(const PointField& field) {
    // The derivative of r / (r^2 + s^2)^(3/2) is zero at r^2 = s^2 / 2.
    return std::abs(field.strength) * 2.0 / (std::sqrt(27.0) * field.softening * field.softening);
}

double fieldPotential(const std::vector<Field>& fields, const Vec3& position) {
    double sum = 0.0;
    for (const Field& field : fields)
        if (field.isConservative())
            sum += std::visit([&](const auto& law) { return potentialOf(law, position); }, field.law);
    return sum;
}

}  // namespace engine
