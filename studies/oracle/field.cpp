// The metaball field of the oracle, and where rays meet its surface: see oracle.h. The roots of its polynomials are
// found in polynomial.h.
#include <algorithm>
#include <cmath>
#include <vector>

#include "studies/oracle/oracle.h"
#include "studies/oracle/polynomial.h"

namespace oracle {
namespace {

/// The square root of a ball's kernel: 1 - d^T M d at a vector d from its center, and 0 where d^T M d is above 1.
double kernelRoot(const Ball& ball, const dvec3& point) {
    const dvec3 offset = point - ball.center;
    return std::max(0.0, 1.0 - glm::dot(offset, ball.form * offset));
}

/// Contribution of a ball to the metaball field at a point.
double kernel(const Ball& ball, const dvec3& point) {
    const double root = kernelRoot(ball, point);
    return ball.weight * root * root;
}

/// A ball that a ray comes within reach of, and the part of the ray within its reach. At a distance t along the ray
/// d^T M d = least + curvature (t - along)^2.
struct CrossedBall {
    double along = 0.0;
    double least = 0.0;
    double curvature = 1.0;  ///< direction^T M direction, 1/m^2
    double weight = 1.0;
    Interval interval;
};

/// Nothing if the ray misses or only touches the ball's reach. The distance `along` is found in two steps, so that d is
/// short and loses no digits: to the foot of the perpendicular, and from there.
std::optional<CrossedBall> crossed(const Ball& ball, const Ray& ray) {
    const double foot = footOf(ray, ball.center).along;
    const dvec3 atFoot = ray.origin + foot * ray.direction - ball.center;
    const dvec3 across = ball.form * ray.direction;
    const double curvature = glm::dot(ray.direction, across);
    const double further = -glm::dot(atFoot, across) / curvature;
    const dvec3 off = atFoot + further * ray.direction;
    const double least = glm::dot(off, ball.form * off);
    if (least >= 1.0) return std::nullopt;
    const double half = std::sqrt((1.0 - least) / curvature);
    const double along = foot + further;
    return CrossedBall{along, least, curvature, ball.weight, {along - half, along + half}};
}

std::vector<CrossedBall> ballsCrossed(const Scene& scene, const Indices& near, const Ray& ray) {
    std::vector<CrossedBall> found;
    for (const std::uint32_t k : near) {
        const std::optional<CrossedBall> ball = crossed(scene.balls[k], ray);
        if (ball && ball->interval.exit > 0.0) found.push_back(*ball);
    }
    return found;
}

/// The metaball field minus the threshold on a part of a ray, as a polynomial in a parameter s that runs from -1 (at
/// `enter`) to 1 (at `exit`). No ball's reach begins or ends within the part. With
///   half = (exit - enter)/2  and  e = (enter + exit)/2 - along,
/// a ball's d^T M d = least + curvature (e + half s)^2, so that
///   1 - d^T M d = a + b s + c s^2
///   with   a = 1 - least - curvature e^2,  b = -2 curvature e half,  c = -curvature half^2
/// and the kernel is the square of this.
Quartic fieldAlong(const std::vector<CrossedBall>& balls, double threshold, const Interval& part) {
    const double half = 0.5 * (part.exit - part.enter);
    Quartic sum{-threshold, 0.0, 0.0, 0.0, 0.0};
    for (const CrossedBall& ball : balls) {
        if (ball.interval.enter > part.enter || ball.interval.exit < part.exit) continue;
        const double e = 0.5 * (part.enter + part.exit) - ball.along;
        const double scale = ball.curvature;
        const double a = 1.0 - ball.least - e * e * scale;
        const double b = -2.0 * e * half * scale;
        const double c = -half * half * scale;
        sum[0] += ball.weight * a * a;
        sum[1] += ball.weight * 2.0 * a * b;
        sum[2] += ball.weight * (b * b + 2.0 * a * c);
        sum[3] += ball.weight * 2.0 * b * c;
        sum[4] += ball.weight * c * c;
    }
    return sum;
}

/// The smallest distance along a ray at which the metaball field is at least the threshold or, if the ray begins inside
/// the metaballs, at most the threshold, m; infinity if there is none. Between neighboring points where the ray enters
/// or leaves the reach of a ball the field is one polynomial, of which all roots are found. The ray is not sampled in
/// steps, so nothing is too thin to be found.
double firstFieldDistance(const Scene& scene, const Indices& near, const Ray& ray, bool isInside = false) {
    const std::vector<CrossedBall> balls = ballsCrossed(scene, near, ray);
    if (isInside && balls.empty()) return 0.0;
    std::vector<double> ends{0.0};
    for (const CrossedBall& ball : balls) {
        if (ball.interval.enter > 0.0) ends.push_back(ball.interval.enter);
        ends.push_back(ball.interval.exit);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Interval part{ends[i], ends[i + 1]};
        if (part.enter == part.exit) continue;
        Quartic excess = fieldAlong(balls, fieldThreshold(scene.view), part);
        if (isInside)
            for (double& coefficient : excess) coefficient = -coefficient;
        if (valueAt(excess, -1.0) >= 0.0) return part.enter;
        if (staysNegative(excess)) continue;
        const std::vector<double> roots = rootsIn(excess, -1.0, 1.0);
        if (!roots.empty()) return part.enter + 0.5 * (roots.front() + 1.0) * (part.exit - part.enter);
    }
    return kInfinity;
}

/// The point where a ray meets the metaball surface, with its normal, color and sky visibility. The gradient of a
/// ball's kernel is -4 (1 - d^T M d) M d, of which the factor 4 drops out of the normal.
Hit hitField(const Scene& scene, const Indices& near, const Ray& ray, bool isInside = false) {
    const render::View& view = scene.view;
    const double distance = firstFieldDistance(scene, near, ray, isInside);
    if (distance == kInfinity) return {};
    Hit hit = hitAt(ray, distance);
    hit.kind = Hit::Kind::particle;
    hit.medium = view.surface.medium;
    hit.isInner = isInside;
    dvec3 downhill{0.0};
    dvec3 colorSum{0.0};
    double kernelSum = 0.0;
    AxisVisibility skySum{};
    for (const std::uint32_t k : near) {
        const Ball& ball = scene.balls[k];
        const double root = kernelRoot(ball, hit.point);
        if (root == 0.0) continue;
        const double weight = kernel(ball, hit.point);
        downhill += ball.weight * root * (ball.form * (hit.point - ball.center));
        colorSum += weight * dvec3(view.particles[k].color);
        kernelSum += weight;
        for (std::size_t side = 0; side < 6; ++side) skySum[side] += weight * scene.sky.ofParticle(k)[side];
    }
    hit.normal = (isInside ? -1.0 : 1.0) * unitOr(downhill, -ray.direction);
    hit.albedo = colorSum / kernelSum;
    for (std::size_t side = 0; side < 6; ++side) hit.sky[side] = skySum[side] / kernelSum;
    return hit;
}

}  // namespace

double fieldAt(const render::View& view, const dvec3& point) {
    double sum = 0.0;
    for (const Ball& ball : ballsOf(view)) sum += kernel(ball, point);
    return sum;
}

double fieldAt(const Scene& scene, const dvec3& point) {
    double sum = 0.0;
    for (const Ball& ball : scene.balls) sum += kernel(ball, point);
    return sum;
}

double fieldAt(const Scene& scene, const Indices& balls, const dvec3& point) {
    double sum = 0.0;
    for (const std::uint32_t k : balls) sum += kernel(scene.balls[k], point);
    return sum;
}

double fieldThreshold(const render::View& view) {
    const double reach = double(view.field.reach);
    const double root = 1.0 - 1.0 / (reach * reach);
    return root * root;
}

Hit traceField(const Scene& scene, const Ray& ray, bool isInside) {
    return hitField(scene, scene.ballsAlong(ray), ray, isInside);
}

bool isFieldMet(const Scene& scene, const Ray& ray) {
    return scene.view.style == render::Style::metaballs &&
           firstFieldDistance(scene, scene.ballsAlong(ray), ray) < kInfinity;
}

}  // namespace oracle
