// A ray is followed surface by surface, in the words of shading_model.h.
#include "studies/oracle/transparency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace oracle {

namespace {

using render::Medium;

dvec3 mediumColor(const dvec3& color) {
    return glm::clamp(color, double(render::kDarkestMedium), 1.0);
}

/// The medium in which a ray is.
struct Inside {
    std::optional<Medium> mesh;  ///< of the mesh around the ray; empty outside of meshes
    bool isInMetaballs = false;
    dvec3 color{1.0};
};

/// F, the share that a surface between two media mirrors.
double mirroredShare(double a, double b, double c) {
    const double h = std::pow((a - b) / (a + b), 2.0);
    const double thinner = a <= b ? c : std::sqrt(std::max(0.0, 1.0 - std::pow(a / b, 2.0) * (1.0 - c * c)));
    return a == b ? 0.0 : h + (1.0 - h) * std::pow(1.0 - thinner, 5.0);
}

/// A little beyond a surface, so that it is not met again, m.
double beyond(const dvec3& point) {
    return 1e-9 * (1.0 + glm::length(point));
}

class Walk {
 public:
    Walk(const Scene& scene, const Ray& ray, const Hit& first) : scene_(scene), ray_{first.point, ray.direction} {
        pass(first, placeBehind(first));
    }

    /// Follows the ray to its end. @return what it meets there
    Hit follow() {
        for (std::size_t passed = 1; passed < render::kMostSurfaces; ++passed) {
            const Hit next = nextSurface();
            if (next.kind == Hit::Kind::none) return {};
            advance(next);
            if (!next.medium.isTransparent()) return next;
            const Inside behind = placeBehind(next);
            if (index(inside_) == 1.0) {
                const double c = -glm::dot(next.normal, ray_.direction);
                mirrored += weight * mirroredShare(1.0, index(behind), c) *
                            surroundings(scene_.view, ray_.direction + 2.0 * c * next.normal);
            }
            pass(next, behind);
        }
        return {};
    }

    const Ray& ray() const { return ray_; }

    dvec3 weight{1.0};    ///< W of shading_model.h
    dvec3 mirrored{0.0};  ///< what later surfaces add to the light of the first

 private:
    double index(const Inside& place) const {
        if (place.mesh) return double(place.mesh->refractiveIndex);
        return place.isInMetaballs ? double(scene_.view.surface.medium.refractiveIndex) : 1.0;
    }

    void advance(const Hit& to) {
        if (inside_.mesh || inside_.isInMetaballs) {
            const Medium& medium = inside_.mesh ? *inside_.mesh : scene_.view.surface.medium;
            weight *= glm::pow(mediumColor(inside_.color), dvec3(to.distance / double(medium.attenuationDistance)));
        }
        ray_.origin = to.point;
    }

    void pass(const Hit& surface, const Inside& behind) {
        const double a = index(inside_);
        const double b = index(behind);
        const double c = std::clamp(-glm::dot(surface.normal, ray_.direction), 0.0, 1.0);
        const double sineSquared = std::pow(a / b, 2.0) * (1.0 - c * c);
        skipped_ = 0.0;
        if (sineSquared >= 1.0) {
            ray_.direction = glm::normalize(ray_.direction + 2.0 * c * surface.normal);
            return;
        }
        weight *= 1.0 - mirroredShare(a, b, c);
        ray_.direction =
            glm::normalize(a / b * ray_.direction + (a / b * c - std::sqrt(1.0 - sineSquared)) * surface.normal);
        inside_ = behind;
        skipped_ = layer_;
    }

    /// A hit with its distance measured from the ray's origin.
    Hit fromOrigin(Hit hit, double start) const {
        hit.distance += start;
        return hit;
    }

    Hit nextSurface() const {
        const double start = beyond(ray_.origin);
        const Hit solid = fromOrigin(traceSolids(scene_, from(start)), start);
        if (inside_.mesh) return onStand(solid);
        if (scene_.view.style == render::Style::spheres) return solid;
        const double begin = start + skipped_;
        const Hit field = fromOrigin(traceField(scene_, from(begin), inside_.isInMetaballs), begin);
        if (field.distance >= solid.distance) return solid;
        return inside_.isInMetaballs && isThin(field.distance, solid) ? solid : field;
    }

    bool isThin(double length, const dvec3& normal) const {
        const double radius = meanRadius(scene_.view);
        return length * std::abs(glm::dot(normal, ray_.direction)) < radius &&
               length < double(render::kLongestLayer) * radius;
    }

    Ray from(double distance) const { return {ray_.origin + distance * ray_.direction, ray_.direction}; }

    /// Whether the air before a solid is a thin layer.
    bool isThin(double begin, const Hit& solid) const {
        return solid.kind != Hit::Kind::none && isThin(solid.distance - begin, solid.normal);
    }

    /// The opaque solid or ground that a mesh touches where the ray would leave it, or else the mesh's own surface.
    Hit onStand(const Hit& own) const {
        if (!own.medium.isTransparent()) return own;
        const double start = own.distance + beyond(own.point);
        const Hit next = fromOrigin(traceSolids(scene_, from(start)), start);
        return !next.medium.isTransparent() && isThin(own.distance, next) ? next : own;
    }

    Inside placeBehind(const Hit& surface) {
        Inside behind;
        behind.color = surface.albedo;
        layer_ = 0.0;
        if (surface.kind == Hit::Kind::particle) {
            behind.isInMetaballs = !surface.isInner;
        } else if (!surface.isInner) {
            behind.mesh = surface.medium;
        } else if (scene_.view.style == render::Style::metaballs && scene_.view.surface.medium.isTransparent()) {
            const Hit field = traceField(scene_, {surface.point, ray_.direction}, false);
            if (isThin(field.distance, surface.normal)) {
                behind.isInMetaballs = true;
                behind.color = field.albedo;
                layer_ = field.distance + 0.01 * meanRadius(scene_.view);
            }
        }
        return behind;
    }

    const Scene& scene_;
    Ray ray_;
    Inside inside_;
    double layer_ = 0.0;    // thickness of the layer between a mesh and the metaballs behind it, along the ray, m
    double skipped_ = 0.0;  // distance in which the ray is known to be in metaballs, m
};

/// What a transparent mesh mirrors of the light and its surroundings.
dvec3 mirroredByMesh(const Scene& scene, const Hit& hit, const Ray& ray) {
    const render::View& view = scene.view;
    const double index = double(hit.medium.refractiveIndex);
    const dvec3 toEye = -ray.direction;
    dvec3 color = mirroredShare(1.0, index, std::max(0.0, glm::dot(hit.normal, toEye))) *
                  surroundings(view, glm::reflect(ray.direction, hit.normal));
    const dvec3 toLight = unitToLight(view);
    if (glm::dot(hit.normal, toLight) <= 0.0) return color;
    const dvec3 visible = view.light.shadows ? lightReaching(scene, hit.point, hit.normal) : dvec3(1.0);
    const dvec3 halfway = unitOr(toLight + toEye, dvec3(0.0));
    const double exponent = std::ldexp(1.0, render::kGlassGloss);
    return color + std::max({visible.x, visible.y, visible.z}) * dvec3(view.light.color) *
                       (mirroredShare(1.0, index, std::max(0.0, glm::dot(toEye, halfway))) * (exponent + 8.0) / 8.0 *
                        std::pow(std::max(0.0, glm::dot(hit.normal, halfway)), exponent));
}

/// Height in the picture, from 0 at the bottom edge to 1 at the top, at which the eye sees a direction.
double screenHeight(const render::View& view, const dvec3& direction, double own) {
    const render::Camera& camera = view.camera;
    if (camera.projection == render::Projection::orthographic) return own;
    const dvec3 forward = glm::normalize(dvec3(camera.target) - dvec3(camera.eye));
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
    const double up = glm::dot(direction, glm::cross(right, forward));
    const double ahead = glm::dot(direction, forward);
    if (ahead <= 0.0) return up > 0.0 ? 1.0 : 0.0;
    return std::clamp(0.5 + 0.5 * up / (ahead * std::tan(0.5 * double(camera.verticalFov))), 0.0, 1.0);
}

}  // namespace

dvec3 colorAlong(const Scene& scene, const Ray& ray, render::PictureSize size, double py) {
    const Hit first = trace(scene, ray);
    const double screenT = 1.0 - py / size.height;
    if (!first.medium.isTransparent()) return shade(scene, first, ray, screenT);
    Walk walk(scene, ray, first);
    const Hit end = walk.follow();
    OwnLight own{1.0 - double(first.medium.transparency), walk.mirrored};
    if (first.kind == Hit::Kind::meshObstacle) own.added += mirroredByMesh(scene, first, ray);
    const Ray last = walk.ray();
    const dvec3 behind =
        glm::clamp(shade(scene, end, last, screenHeight(scene.view, last.direction, screenT)), 0.0, 1.0);
    return glm::clamp(shade(scene, first, ray, screenT, own), 0.0, 1.0) +
           double(first.medium.transparency) * walk.weight * behind;
}

dvec3 columnTransmission(const render::View& view, const dvec3& point) {
    const dvec3 toLight = unitToLight(view);
    dvec3 depth{0.0};
    for (const render::Sphere& particle : view.particles) {
        const double radius = double(particle.radius);
        const double reach = double(render::kSplatReach) * radius;
        const double squared = footOf({point, toLight}, dvec3(particle.center)).offSquared;
        if (radius == 0.0 || squared >= reach * reach) continue;
        const double thickness = 3.0 * double(render::kBodyVolume) * std::pow(radius, 3.0) /
                                 (std::numbers::pi * reach * reach) * std::pow(1.0 - squared / (reach * reach), 2.0);
        depth -= glm::log2(mediumColor(dvec3(particle.color))) *
                 (thickness / double(view.surface.medium.attenuationDistance));
    }
    return glm::exp2(-depth);
}

}  // namespace oracle
