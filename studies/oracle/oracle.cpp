// The oracle's ray caster, see oracle.h. From top to bottom: the nearest surface, shading, the picture. The metaball
// field is in field.cpp, spheres, boxes and the ground in intersections.h.
#include "studies/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "studies/oracle/soft_shadows.h"
#include "studies/oracle/transparency.h"

namespace oracle {
namespace {

/// Replaces the nearest hit so far by another hit, of a surface of this kind and color, if that is nearer.
void keepNearer(Hit& best, Hit candidate, Hit::Kind kind, const glm::vec3& color) {
    candidate.kind = kind;
    candidate.albedo = dvec3(color);
    if (candidate.distance < best.distance) best = candidate;
}

/// How far above its own surface a ray to the light begins, m: about a million roundings of the point's coordinates,
/// which is never visible.
double lift(const dvec3& point) {
    return 1e-9 * (1.0 + glm::length(point));
}

/// The nearest point along a ray on a surface other than metaballs, meshes and the ground.
Hit traceShapes(const Scene& scene, const Ray& ray) {
    const render::View& view = scene.view;
    Hit best;
    if (view.style == render::Style::spheres) {
        for (const std::uint32_t k : scene.ballsAlong(ray)) {
            const render::Sphere& sphere = view.particles[k];
            Hit hit = hitSphere(ray, dvec3(sphere.center), sphere.radius);
            hit.sky = scene.sky.ofParticle(k);
            keepNearer(best, hit, Hit::Kind::particle, sphere.color);
        }
    }
    for (const render::SphereObstacle& sphere : view.sphereObstacles)
        keepNearer(best, hitSphere(ray, dvec3(sphere.center), sphere.radius), Hit::Kind::sphereObstacle, sphere.color);
    for (const render::BoxObstacle& box : view.boxObstacles)
        keepNearer(best, hitBox(ray, box), Hit::Kind::boxObstacle, box.color);
    return best;
}

/// The share of the light that reaches a point of each color, of which metaballs and other things cover these shares.
dvec3 uncovered(const Scene& scene, const dvec3& point, double metaballs, double others) {
    const double transparency = double(scene.view.surface.medium.transparency);
    if (transparency == 0.0 || metaballs == 0.0) return dvec3(std::max(0.0, 1.0 - others - metaballs));
    const dvec3 opaque = 1.0 - transparency * columnTransmission(scene.view, point);
    return glm::max(dvec3(0.0), 1.0 - others - metaballs * opaque);
}

/// The share of the light that meshes cover at a point.
double coverOfMeshes(const Scene& scene, const ShadedPoint& shaded) {
    if (scene.view.meshObstacles.empty()) return 0.0;
    double met = 0.0;
    const std::vector<dvec3> origins = meshShadowOrigins(shaded, meanRadius(scene.view));
    for (const dvec3& origin : origins) {
        const Ray ray{origin + lift(shaded.point) * shaded.normal, shaded.toLight};
        met += scene.meshes.isEntered(ray) ? 1.0 : 0.0;
    }
    return met / static_cast<double>(origins.size());
}

// The functions below are named after the terms of section 1 of shading_model.h.

dvec3 fresnel(const render::View& view, const dvec3& albedo, double cosine) {
    const dvec3 headOn = glm::mix(dvec3(view.surface.specular), albedo, double(view.surface.metal));
    return headOn + (1.0 - headOn) * std::pow(1.0 - std::max(0.0, cosine), 5.0);
}

/// The specular highlight of the light, without the light's color and visibility.
/// @pre the surface faces the light
dvec3 highlight(const render::View& view, const Hit& hit, const dvec3& toEye, const dvec3& toLight) {
    if (view.surface.specular == 0.0F && view.surface.metal == 0.0F) return dvec3{0.0};
    const dvec3 halfway = unitOr(toLight + toEye, dvec3{0.0});
    const double exponent = std::ldexp(1.0, view.surface.glossExponent);
    return fresnel(view, hit.albedo, glm::dot(toEye, halfway)) *
           ((exponent + 8.0) / 8.0 * std::pow(std::max(0.0, glm::dot(hit.normal, halfway)), exponent));
}

dvec3 skyLight(const render::View& view, const dvec3& d) {
    return glm::mix(dvec3(view.ambient.ground), dvec3(view.ambient.sky), 0.5 + 0.5 * d.y);
}

dvec3 shoulder(const dvec3& color) {
    const double peak = std::max({color.x, color.y, color.z});
    if (peak <= 0.7) return color;
    const double kept = 1.0 - 0.09 / (peak - 0.4);
    return glm::mix(kept / peak * color, dvec3(kept), 1.0 - 1.0 / (1.0 + 0.06 * (peak - kept)));
}

/// The sky visibility of a hit: on particles that of the particle, on obstacles and the ground that of the point.
AxisVisibility skyVisibility(const Scene& scene, const Hit& hit) {
    if (hit.kind == Hit::Kind::particle) return hit.sky;
    AxisVisibility sky = scene.sky.at(hit.point);
    if (scene.view.style == render::Style::metaballs)
        for (double& open : sky) open = 1.0 - (1.0 - double(scene.view.surface.medium.transparency)) * (1.0 - open);
    return sky;
}

/// @param bodyShare  share of the body's color that is seen
/// @param added      light that is mirrored beside the surface's own terms
dvec3 shadeSurface(const Scene& scene, const Hit& hit, const Ray& ray, double bodyShare, const dvec3& added) {
    const render::View& view = scene.view;
    const bool isParticle = hit.kind == Hit::Kind::particle;
    // Obstacles and the ground are matt: they have no highlight, reflection, translucency or glow.
    const render::Surface surface = isParticle ? view.surface : render::Surface{};
    const dvec3 toLight = unitToLight(view);
    const dvec3 toEye = -ray.direction;
    const dvec3& n = hit.normal;
    const dvec3 light(view.light.color);
    const bool isLit = glm::dot(n, toLight) > 0.0;
    const dvec3 visible = !isLit ? dvec3(0.0) : view.light.shadows ? lightReaching(scene, hit.point, n) : dvec3(1.0);
    const AxisVisibility sky = skyVisibility(scene, hit);
    double cosine = std::max(0.0, glm::dot(n, toLight));
    const double dust = 2.2 / (cosine + std::max(0.0, glm::dot(n, toEye)) + 0.2);
    cosine *= 1.0 + double(surface.roughness) * (dust - 1.0);
    const dvec3 ambient = skyLight(view, n) * (1.0 - double(view.ambient.occlusion) * (1.0 - visibilityToward(sky, n)));
    const dvec3 diffuse = light * (cosine * visible);
    const dvec3 transmitted = double(surface.translucency) * visibilityToward(sky, -n) *
                              (skyLight(view, -n) + light * (0.25 + std::max(0.0, -glm::dot(n, toLight))));
    const dvec3 body =
        glm::mix(hit.albedo, hit.albedo * hit.albedo, double(surface.absorption) * (1.0 - visibilityToward(sky, -n)));
    dvec3 color = bodyShare * (1.0 - double(surface.metal)) * body *
                      (ambient + diffuse + transmitted + scene.glow.at(hit.point, n)) +
                  added;
    const dvec3 mirror = glm::reflect(ray.direction, n);
    const double unhidden = 1.0 - double(view.ambient.occlusion) * (1.0 - visibilityToward(sky, mirror));
    if (isParticle && isLit) color += visible * unhidden * light * highlight(view, hit, toEye, toLight);
    const double open = 1.0 - double(view.ambient.occlusion) * (1.0 - visibilityToward(sky, n));
    if (isParticle)
        color +=
            std::pow(1.0 - std::max(0.0, glm::dot(n, toEye)), 4.0) * (0.5 + 0.5 * n.y) * open * dvec3(view.light.rim);
    color += double(surface.reflection) * fresnel(view, hit.albedo, glm::dot(n, toEye)) *
             visibilityToward(sky, mirror) * surroundings(view, mirror);
    color += double(surface.glow) * hit.albedo * hit.albedo;
    return view.exposure > 0.0F ? shoulder(double(view.exposure) * color) : color;
}

}  // namespace

dvec3 surroundings(const render::View& view, const dvec3& d) {
    const render::Surroundings& around = view.surroundings;
    if (d.y > 0.0) return glm::mix(dvec3(around.horizon), dvec3(around.top), d.y * (2.0 - d.y));
    return glm::mix(dvec3(around.horizon), dvec3(around.bottom), std::min(1.0, -4.0 * d.y));
}

dvec3 unitToLight(const render::View& view) {
    return glm::normalize(dvec3(view.light.toLight));
}

Hit traceSolids(const Scene& scene, const Ray& ray) {
    Hit best = traceShapes(scene, ray);
    const Hit onMesh = scene.meshes.nearest(ray);
    if (onMesh.distance < best.distance) best = onMesh;
    if (scene.view.ground)
        keepNearer(best, hitGround(ray, *scene.view.ground), Hit::Kind::ground, scene.view.ground->color);
    return best;
}

Scene::Scene(const render::View& view_, bool bruteForce)
    : view(view_),
      balls(ballsOf(view_)),
      sky(view_),
      meshes(view_),
      shadowBoxes(oracle::shadowBoxes(view_.boxObstacles)),
      glow(view_, sky) {
    if (bruteForce) return;
    std::vector<Extent> extents;
    for (std::size_t k = 0; k < balls.size(); ++k) {
        // A sphere's soft shadow is wider than the sphere.
        const double sphere = double(view.particles[k].radius) * (1.0 + 0.5 * double(view.light.softness));
        extents.push_back({balls[k].center, view.style == render::Style::metaballs ? balls[k].reach : sphere});
    }
    grid.emplace(extents);
}

Indices Scene::ballsAlong(const Ray& ray) const {
    if (grid) return grid->along(ray);
    Indices all(balls.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

Ray pixelRay(const render::View& view, render::PictureSize size, double px, double py) {
    const render::Camera& camera = view.camera;
    const dvec3 eye(camera.eye);
    const dvec3 forward = glm::normalize(dvec3(camera.target) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
    if (!std::isfinite(right.x))
        throw std::domain_error("pixelRay: the eye is at its target, or up is parallel to the view");
    const dvec3 up = glm::cross(right, forward);
    // Position of the pixel relative to the center of the picture, in units of half the picture's height.
    const double x = (2.0 * px - size.width) / size.height;
    const double y = 1.0 - 2.0 * py / size.height;
    const dvec3 across = x * right + y * up;
    if (camera.projection == render::Projection::orthographic)
        return {eye + double(camera.halfHeight) * across, forward};
    return {eye, glm::normalize(forward + std::tan(0.5 * double(camera.verticalFov)) * across)};
}

Hit trace(const render::View& view, const Ray& ray) {
    return trace(Scene(view, true), ray);
}

Hit trace(const Scene& scene, const Ray& ray) {
    const render::View& view = scene.view;
    const Hit onSolid = traceSolids(scene, ray);
    if (view.style == render::Style::spheres) return onSolid;
    const Hit onField = traceField(scene, ray, false);
    return onField.distance <= onSolid.distance ? onField : onSolid;
}

double meanRadius(const render::View& view) {
    double sum = 0.0;
    for (const render::Sphere& particle : view.particles) sum += double(particle.radius);
    return view.particles.empty() ? 0.0 : sum / static_cast<double>(view.particles.size());
}

bool isInShadow(const Scene& scene, const dvec3& point, const dvec3& normal) {
    const Ray ray{point + lift(point) * normal, unitToLight(scene.view)};
    return isFieldMet(scene, ray) || traceShapes(scene, ray).kind != Hit::Kind::none || scene.meshes.isEntered(ray);
}

dvec3 lightReaching(const Scene& scene, const dvec3& point, const dvec3& normal) {
    const render::View& view = scene.view;
    if (view.light.softness == 0.0F) {
        const Ray ray{point + lift(point) * normal, unitToLight(view)};
        const bool isCovered = traceShapes(scene, ray).kind != Hit::Kind::none || scene.meshes.isEntered(ray);
        return uncovered(scene, point, isFieldMet(scene, ray) ? 1.0 : 0.0, isCovered ? 1.0 : 0.0);
    }
    const ShadedPoint shaded{point, normal, unitToLight(view), double(view.light.softness)};
    double cover = coverOfMeshes(scene, shaded);
    double ofMetaballs = 0.0;
    if (view.style == render::Style::spheres) {
        for (const std::uint32_t k : scene.ballsAlong({point, shaded.toLight}))
            cover += coverOfSphere(shaded, dvec3(view.particles[k].center), double(view.particles[k].radius));
    } else {
        const std::vector<dvec3> origins = fieldShadowOrigins(shaded, meanRadius(view));
        for (const dvec3& origin : origins) ofMetaballs += isFieldMet(scene, {origin, shaded.toLight}) ? 1.0 : 0.0;
        ofMetaballs /= static_cast<double>(origins.size());
    }
    for (const render::SphereObstacle& sphere : view.sphereObstacles)
        cover += coverOfSphere(shaded, dvec3(sphere.center), double(sphere.radius));
    for (const SignedBox& term : scene.shadowBoxes) cover += term.sign * coverOfBox(shaded, term.box, meanRadius(view));
    return uncovered(scene, point, ofMetaballs, cover);
}

double lightVisibility(const Scene& scene, const dvec3& point, const dvec3& normal) {
    const dvec3 reaching = lightReaching(scene, point, normal);
    return std::max({reaching.x, reaching.y, reaching.z});
}

dvec3 shade(const render::View& view, const Hit& hit, const Ray& ray, double screenT) {
    return shade(Scene(view, true), hit, ray, screenT);
}

dvec3 shade(const Scene& scene, const Hit& hit, const Ray& ray, double screenT, const OwnLight& own) {
    const render::View& view = scene.view;
    const dvec3 background = glm::mix(dvec3(view.background.bottom), dvec3(view.background.top), screenT);
    if (hit.kind == Hit::Kind::none) return background;
    const dvec3 color = shadeSurface(scene, hit, ray, own.bodyShare, own.added);
    if (hit.kind != Hit::Kind::ground) return color;
    const double relative = glm::distance(hit.point, dvec3(view.ground->center)) / double(view.ground->fadeDistance);
    const double fade = std::pow(relative, 4.0);
    return glm::mix(color, background, 1.0 / (1.0 + 1.0 / fade));  // fade/(1 + fade), also for fade = 0 and infinity
}

double ditherThreshold(int x, int y) {
    // The index m is the Bayer matrix, built from that of 2 x 2 pixels by its recurrence.
    constexpr std::array<std::array<int, 2>, 2> kQuarter = {{{0, 2}, {3, 1}}};
    int m = 0;
    for (int side = 1, scale = 16; side < 8; side *= 2, scale /= 4)
        m += scale * kQuarter[static_cast<std::size_t>(y / side % 2)][static_cast<std::size_t>(x / side % 2)];
    return (m + 0.5) / 64.0;
}

std::uint8_t encodeSrgb(double linear, double threshold) {
    if (!(linear >= 0.0 && linear <= 1.0))
        throw std::domain_error("encodeSrgb: " + std::to_string(linear) + " is not in [0,1]");
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::min(std::floor(255.0 * encoded + threshold), 255.0));
}

Picture draw(const render::View& view, render::PictureSize size, int samplesPerAxis) {
    return drawWindow(Scene(view), size, {0, 0, size.width, size.height}, samplesPerAxis);
}

Picture drawWindow(const Scene& scene, render::PictureSize size, const Window& window, int samplesPerAxis) {
    const render::View& view = scene.view;
    Picture picture{window.width, window.height, {}, {}, {}, {}};
    const auto sampleAt = [&](double px, double py) {
        const Ray ray = pixelRay(view, size, px, py);
        return glm::clamp(colorAlong(scene, ray, size, py), 0.0, 1.0);
    };
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Hit hit = trace(scene, pixelRay(view, size, x + 0.5, y + 0.5));
            picture.kinds.push_back(hit.kind);
            picture.distances.push_back(hit.distance);
            picture.normals.push_back(hit.normal);
            dvec3 sum{0.0};
            for (int j = 0; j < samplesPerAxis; ++j)
                for (int i = 0; i < samplesPerAxis; ++i)
                    sum += sampleAt(x + (i + 0.5) / samplesPerAxis, y + (j + 0.5) / samplesPerAxis);
            const dvec3 mean = glm::clamp(sum / double(samplesPerAxis * samplesPerAxis), 0.0, 1.0);
            for (int channel = 0; channel < 3; ++channel)
                picture.rgb.push_back(encodeSrgb(mean[channel], ditherThreshold(x, y)));
        }
    }
    return picture;
}

}  // namespace oracle
