// The oracle's ray caster, see oracle.h. From top to bottom: the metaball field, the nearest surface, light, the
// picture. Balls, boxes and the ground are in oracle_solids.h, the roots of the field's polynomials in polynomial.h.
#include "studies/oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "studies/oracle_solids.h"
#include "studies/polynomial.h"

namespace oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double reachOf(const render::View& view, const render::Sphere& ball) {
    return double(view.field.reach) * double(ball.radius);
}

/// 1 - d^2/R^2, the square root of the kernel, or 0 outside of the ball's reach.
double kernelRoot(const render::View& view, const render::Sphere& ball, const dvec3& point) {
    const dvec3 offset = point - dvec3(ball.center);
    const double reach = reachOf(view, ball);
    const double squared = glm::dot(offset, offset);
    return squared < reach * reach ? 1.0 - squared / (reach * reach) : 0.0;
}

/// A ball whose reach a ray crosses.
struct CrossedBall {
    Foot foot;
    double reach = 0.0;
    Chord chord;
};

std::vector<CrossedBall> ballsCrossed(const render::View& view, const Indices& near, const Ray& ray) {
    std::vector<CrossedBall> crossed;
    for (const std::uint32_t k : near) {
        const render::Sphere& ball = view.particles[k];
        const Foot foot = footOf(ray, dvec3(ball.center));
        const double reach = reachOf(view, ball);
        const std::optional<Chord> chord = chordOf(foot, reach);
        if (chord && chord->exit > 0.0) crossed.push_back({foot, reach, *chord});
    }
    return crossed;
}

/// The field minus the threshold on the stretch from low to high of a ray, as a polynomial in s from -1 (low) to 1
/// (high). With half = (high - low)/2, e = (low + high)/2 - middle, a ball's d^2 = offSquared + (e + half s)^2, so that
///   1 - d^2/R^2 = a + b s + c s^2   with   a = 1 - (offSquared + e^2)/R^2,  b = -2 e half/R^2,  c = -half^2/R^2
/// and the kernel is its square. No ball may begin or end inside the stretch.
Quartic fieldAlong(const std::vector<CrossedBall>& balls, double threshold, const Chord& stretch) {
    const double half = 0.5 * (stretch.exit - stretch.enter);
    Quartic sum{-threshold, 0.0, 0.0, 0.0, 0.0};
    for (const CrossedBall& ball : balls) {
        if (ball.chord.enter > stretch.enter || ball.chord.exit < stretch.exit) continue;
        const double e = 0.5 * (stretch.enter + stretch.exit) - ball.foot.middle;
        const double scale = 1.0 / (ball.reach * ball.reach);
        const double a = 1.0 - (ball.foot.offSquared + e * e) * scale;
        const double b = -2.0 * e * half * scale;
        const double c = -half * half * scale;
        sum[0] += a * a;
        sum[1] += 2.0 * a * b;
        sum[2] += b * b + 2.0 * a * c;
        sum[3] += 2.0 * b * c;
        sum[4] += c * c;
    }
    return sum;
}

/// The first distance from 0 on where the field is at least the threshold; infinity without one. Between neighbouring
/// entries and exits the field is one polynomial, whose roots are all found: no step, so no sliver is too thin.
double firstFieldDistance(const render::View& view, const Indices& near, const Ray& ray) {
    const std::vector<CrossedBall> balls = ballsCrossed(view, near, ray);
    std::vector<double> ends{0.0};
    for (const CrossedBall& ball : balls) {
        if (ball.chord.enter > 0.0) ends.push_back(ball.chord.enter);
        ends.push_back(ball.chord.exit);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Chord stretch{ends[i], ends[i + 1]};
        if (stretch.enter == stretch.exit) continue;
        const Quartic excess = fieldAlong(balls, fieldThreshold(view), stretch);
        if (valueAt(excess, -1.0) >= 0.0) return stretch.enter;
        if (staysNegative(excess)) continue;
        const std::vector<double> roots = rootsIn(excess, -1.0, 1.0);
        if (!roots.empty()) return stretch.enter + 0.5 * (roots.front() + 1.0) * (stretch.exit - stretch.enter);
    }
    return kInfinity;
}

/// The kernel's gradient is -4 (1 - d^2/R^2) (x - c)/R^2; the factor 4 drops out of the normal.
Hit hitField(const render::View& view, const Indices& near, const Ray& ray) {
    const double distance = firstFieldDistance(view, near, ray);
    if (distance == kInfinity) return {};
    Hit hit;
    hit.kind = Hit::Kind::particle;
    hit.distance = distance;
    hit.point = ray.origin + distance * ray.direction;
    dvec3 downhill{0.0};
    dvec3 colorSum{0.0};
    double kernelSum = 0.0;
    for (const std::uint32_t k : near) {
        const render::Sphere& ball = view.particles[k];
        const double root = kernelRoot(view, ball, hit.point);
        if (root == 0.0) continue;
        const double reach = reachOf(view, ball);
        downhill += root / (reach * reach) * (hit.point - dvec3(ball.center));
        colorSum += root * root * dvec3(ball.color);
        kernelSum += root * root;
    }
    hit.normal = unitOr(downhill, -ray.direction);
    hit.albedo = colorSum / kernelSum;
    return hit;
}

void keepNearer(Hit& best, const Hit& candidate) {
    if (candidate.distance < best.distance) best = candidate;
}

void keepNearer(Hit& best, Hit candidate, Hit::Kind kind, const glm::vec3& color) {
    candidate.kind = kind;
    candidate.albedo = dvec3(color);
    keepNearer(best, candidate);
}

/// Everything that casts shadows: all but the ground.
Hit traceCasters(const render::View& view, const Crowd& crowd, const Ray& ray) {
    Hit best;
    const Indices near = crowd.along(ray);
    if (view.style == render::Style::metaballs) {
        keepNearer(best, hitField(view, near, ray));
    } else {
        for (const std::uint32_t k : near) {
            const render::Sphere& sphere = view.particles[k];
            keepNearer(best, hitSphere(ray, dvec3(sphere.center), sphere.radius), Hit::Kind::particle, sphere.color);
        }
    }
    for (const render::SphereObstacle& sphere : view.sphereObstacles)
        keepNearer(best, hitSphere(ray, dvec3(sphere.center), sphere.radius), Hit::Kind::sphereObstacle, sphere.color);
    for (const render::BoxObstacle& box : view.boxObstacles)
        keepNearer(best, hitBox(ray, box), Hit::Kind::boxObstacle, box.color);
    return best;
}

dvec3 unitToLight(const render::View& view) {
    return glm::normalize(dvec3(view.light.toLight));
}

/// Fresnel, gloss and cone of the glint, without the light's colour and visibility; toLight must be on the normal's
/// side.
double glint(const render::Surface& surface, const dvec3& normal, const dvec3& toEye, const dvec3& toLight) {
    if (surface.specular == 0.0F) return 0.0;
    const dvec3 halfway = unitOr(toLight + toEye, dvec3{0.0});
    const double gloss = std::ldexp(1.0, surface.glossExponent);
    const double specular = double(surface.specular);
    const double fresnel = specular + (1.0 - specular) * std::pow(1.0 - std::max(0.0, glm::dot(toEye, halfway)), 5.0);
    return fresnel * (gloss + 8.0) / 8.0 * std::pow(std::max(0.0, glm::dot(normal, halfway)), gloss);
}

dvec3 shadeSurface(const render::View& view, const Crowd& crowd, const Hit& hit, const Ray& ray) {
    const dvec3 toLight = unitToLight(view);
    const double cosine = glm::dot(hit.normal, toLight);
    const dvec3 ambient = glm::mix(dvec3(view.ambient.ground), dvec3(view.ambient.sky), 0.5 + 0.5 * hit.normal.y);
    if (cosine <= 0.0 || (view.light.shadows && inShadow(view, crowd, hit.point, hit.normal)))
        return hit.albedo * ambient;
    const dvec3 light = dvec3(view.light.color);
    const dvec3 matt = hit.albedo * (ambient + light * cosine);
    if (hit.kind != Hit::Kind::particle) return matt;
    return matt + light * glint(view.surface, hit.normal, -ray.direction, toLight);
}

}  // namespace

Ray pixelRay(const render::View& view, render::PictureSize size, double px, double py) {
    const render::Camera& camera = view.camera;
    const dvec3 eye(camera.eye);
    const dvec3 forward = glm::normalize(dvec3(camera.target) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
    if (!std::isfinite(right.x)) throw std::domain_error("pixelRay: the camera looks nowhere or along its up");
    const dvec3 up = glm::cross(right, forward);
    // In units of half the picture's height, from its centre.
    const double x = (2.0 * px - size.width) / size.height;
    const double y = 1.0 - 2.0 * py / size.height;
    const dvec3 across = x * right + y * up;
    if (camera.projection == render::Projection::orthographic)
        return {eye + double(camera.halfHeight) * across, forward};
    return {eye, glm::normalize(forward + std::tan(0.5 * double(camera.verticalFov)) * across)};
}

Hit trace(const render::View& view, const Ray& ray) {
    return trace(view, Crowd::everyone(view), ray);
}

Hit trace(const render::View& view, const Crowd& crowd, const Ray& ray) {
    Hit best = traceCasters(view, crowd, ray);
    if (view.ground) keepNearer(best, hitGround(ray, *view.ground), Hit::Kind::ground, view.ground->color);
    return best;
}

double fieldAt(const render::View& view, const dvec3& point) {
    double sum = 0.0;
    for (const render::Sphere& ball : view.particles) {
        const double root = kernelRoot(view, ball, point);
        sum += root * root;
    }
    return sum;
}

double fieldThreshold(const render::View& view) {
    const double reach = double(view.field.reach);
    const double root = 1.0 - 1.0 / (reach * reach);
    return root * root;
}

bool inShadow(const render::View& view, const Crowd& crowd, const dvec3& point, const dvec3& normal) {
    // Lifts the start off its own surface: a million roundings of the coordinates, still far below anything visible.
    const double lift = 1e-9 * (1.0 + glm::length(point));
    return traceCasters(view, crowd, {point + lift * normal, unitToLight(view)}).kind != Hit::Kind::none;
}

dvec3 shade(const render::View& view, const Hit& hit, const Ray& ray, double screenT) {
    return shade(view, Crowd::everyone(view), hit, ray, screenT);
}

dvec3 shade(const render::View& view, const Crowd& crowd, const Hit& hit, const Ray& ray, double screenT) {
    const dvec3 background = glm::mix(dvec3(view.background.bottom), dvec3(view.background.top), screenT);
    if (hit.kind == Hit::Kind::none) return background;
    const dvec3 color = shadeSurface(view, crowd, hit, ray);
    if (hit.kind != Hit::Kind::ground) return color;
    const double relative = glm::distance(hit.point, dvec3(view.ground->center)) / double(view.ground->fadeDistance);
    const double fade = std::pow(relative, 4.0);
    return glm::mix(color, background, 1.0 / (1.0 + 1.0 / fade));  // fade/(1 + fade), also for fade = 0 and infinity
}

std::uint8_t encodeSrgb(double linear) {
    if (!(linear >= 0.0 && linear <= 1.0))
        throw std::domain_error("encodeSrgb: " + std::to_string(linear) + " is not in [0,1]");
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::floor(255.0 * encoded + 0.5));
}

Picture draw(const render::View& view, render::PictureSize size, int samplesPerAxis) {
    return drawWindow(view, Crowd(view), size, {0, 0, size.width, size.height}, samplesPerAxis);
}

Picture drawWindow(const render::View& view, const Crowd& crowd, render::PictureSize size, const Window& window,
                   int samplesPerAxis) {
    Picture picture{window.width, window.height, {}, {}, {}, {}};
    const auto sampleAt = [&](double px, double py) {
        const Ray ray = pixelRay(view, size, px, py);
        return glm::clamp(shade(view, crowd, trace(view, crowd, ray), ray, 1.0 - py / size.height), 0.0, 1.0);
    };
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Hit hit = trace(view, crowd, pixelRay(view, size, x + 0.5, y + 0.5));
            picture.kinds.push_back(hit.kind);
            picture.distances.push_back(hit.distance);
            picture.normals.push_back(hit.normal);
            dvec3 sum{0.0};
            for (int j = 0; j < samplesPerAxis; ++j)
                for (int i = 0; i < samplesPerAxis; ++i)
                    sum += sampleAt(x + (i + 0.5) / samplesPerAxis, y + (j + 0.5) / samplesPerAxis);
            const dvec3 mean = glm::clamp(sum / double(samplesPerAxis * samplesPerAxis), 0.0, 1.0);
            for (int channel = 0; channel < 3; ++channel) picture.rgb.push_back(encodeSrgb(mean[channel]));
        }
    }
    return picture;
}

}  // namespace oracle
