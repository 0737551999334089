// From surface to surface: the next surface, the media on both sides, refraction or total reflection.
#include "render/cpu/transparency/light_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "render/cpu/transparency/attenuation.h"
#include "render/cpu/transparency/field_crossing.h"
#include "render/cpu/transparency/solid_hits.h"

namespace render {

namespace {

constexpr float kAirIndex = 1.0F;

/// Where a ray is: in a mesh, in metaballs, or in air.
struct Place {
    std::optional<std::size_t> mesh;  ///< index of the mesh that the ray is in; metaballs in it do not count
    bool isInMetaballs = false;
    glm::vec3 color{1.0F};  ///< of the medium
};

/// A surface that the ray comes to.
struct NextSurface {
    float distance = 0.0F;  ///< m
    std::int32_t hitId = kHitBackground;
    glm::vec3 normal{0.0F};  ///< unit normal on the side of the ray
    glm::vec3 color{0.0F};
    bool isInner = false;  ///< whether the ray comes from the inside of a mesh
};

/// Sky visibility at a particle's surface along three directions.
glm::vec3 particleSkyToward(const SkyVisibility& sky, glm::vec3 normal, glm::vec3 direction) {
    const auto toward = [&](glm::vec3 d) {
        float sum = 0.0F;
        for (int axis = 0; axis < 3; ++axis)
            sum += d[axis] * d[axis] * sky[static_cast<std::size_t>(2 * axis + (d[axis] < 0.0F ? 1 : 0))];
        return sum;
    };
    return {toward(normal), toward(-normal), toward(direction - 2.0F * dot(direction, normal) * normal)};
}

class RayWalk {
 public:
    RayWalk(const PreparedView& view, const ShadingGeometry& geometry, BallCache& cache)
        : view_(view),
          geometry_(geometry),
          field_{view.ballCells, view.fieldCells, view.metaballs.threshold, view.metaballs.step, cache},
          // Chosen: below what can be seen, above the error of interpolated primary hits.
          lift_(0.05F * view.metaballs.smallestRadius) {}

    LightPath follow(const FirstSurface& first) {
        origin_ = first.position;
        path_.direction = first.direction;
        Place inside;
        inside.color = first.color;
        if (first.hitId >= kHitMetaballs)
            inside.isInMetaballs = true;
        else
            inside.mesh = meshOf(first.hitId);
        pass(first.normal, inside);
        for (std::size_t passed = 1; passed < kMostSurfaces; ++passed) {
            if (std::max({path_.weight.x, path_.weight.y, path_.weight.z}) < kFaintest) break;
            const NextSurface next = nextSurface();
            if (next.hitId == kHitBackground) break;
            advance(next.distance);
            if (!isTransparent(next.hitId)) {
                endAt(next);
                break;
            }
            const Place beyond = placeBeyond(next);
            if (index(place_) == kAirIndex) addMirrored(next.normal, beyond);
            pass(next.normal, beyond);
        }
        return path_;
    }

 private:
    std::size_t meshOf(std::int32_t hitId) const {
        return view_.meshes.triangles[static_cast<std::size_t>(hitId - kHitTriangle)].mesh;
    }

    bool isTransparent(std::int32_t hitId) const {
        const Medium* medium = mediumOf(view_, hitId);
        return medium != nullptr;
    }

    const Medium* mediumAt(const Place& place) const {
        if (place.mesh) return &view_.meshes.obstacles[*place.mesh].medium;
        return place.isInMetaballs ? &view_.view->surface.medium : nullptr;
    }

    float index(const Place& place) const {
        const Medium* medium = mediumAt(place);
        return medium == nullptr ? kAirIndex : medium->refractiveIndex;
    }

    /// Goes on along the ray, and loses light to the medium.
    void advance(float distance) {
        if (const Medium* medium = mediumAt(place_)) path_.weight *= attenuation(*medium, place_.color, distance);
        origin_ += distance * path_.direction;
        path_.length += distance;
    }

    /// Goes through a surface, or is mirrored by it where it cannot be refracted.
    /// @param normal  on the side of the ray
    void pass(glm::vec3 normal, const Place& beyond) {
        const float from = index(place_);
        const float to = index(beyond);
        const float cosine = std::clamp(-dot(normal, path_.direction), 0.0F, 1.0F);
        const float ratio = from / to;
        const float squaredSine = ratio * ratio * (1.0F - cosine * cosine);
        if (squaredSine >= 1.0F) {
            path_.direction = normalize(path_.direction + 2.0F * cosine * normal);
            searchFrom_ = lift_;
            return;
        }
        path_.weight *= 1.0F - mirroredShare(from, to, cosine);
        path_.direction =
            normalize(ratio * path_.direction + (ratio * cosine - std::sqrt(1.0F - squaredSine)) * normal);
        place_ = beyond;
        searchFrom_ = std::max(lift_, layer_);
        layer_ = 0.0F;
    }

    /// Adds what a surface in air mirrors.
    void addMirrored(glm::vec3 normal, const Place& beyond) {
        const float cosine = -dot(normal, path_.direction);
        const glm::vec3 mirrored = path_.direction + 2.0F * cosine * normal;
        path_.mirrored += path_.weight * mirroredShare(kAirIndex, index(beyond), std::clamp(cosine, 0.0F, 1.0F)) *
                          surroundingsToward(view_.view->surroundings, mirrored);
    }

    NextSurface nextSurface() {
        // Positions are rounded by some 1e-7 of their distance from the eye.
        const float least = 1e-5F * length(origin_);
        const SolidHit solid = nearestSolid(view_.solids, geometry_, origin_, path_.direction, least);
        const bool isInMesh = place_.mesh.has_value();
        if (!isInMesh && !view_.ballCells.empty()) {
            crossing_ =
                findCrossing(field_, {origin_, path_.direction, searchFrom_, solid.distance}, place_.isInMetaballs);
            if (crossing_.distance < solid.distance && !isInContact(solid)) return surfaceOfMetaballs();
        }
        return solid.isNone() ? NextSurface{} : surfaceOfSolid(isInMesh ? beyondContact(solid) : solid);
    }

    NextSurface surfaceOfSolid(const SolidHit& solid) const {
        const SolidSurface surface = surfaceAt(geometry_, origin_, path_.direction, solid);
        return {solid.distance, solid.hitId, surface.normal, surface.color, surface.isInner};
    }

    /// The opaque solid or ground that the mesh stands on where the ray leaves it, or else the mesh's own surface.
    SolidHit beyondContact(const SolidHit& own) const {
        if (!isTransparent(own.hitId)) return own;
        const SolidHit next = nearestSolid(view_.solids, geometry_, origin_, path_.direction, own.distance,
                                           own.distance + kLongestLayer * view_.meanRadius);
        return !next.isNone() && !isTransparent(next.hitId) && isThin(own.distance, next) ? next : own;
    }

    /// Whether the layer before a solid is so thin that the bodies on both sides are in contact.
    /// @param from  distance at which it begins, m
    bool isThin(float from, const SolidHit& solid) const {
        const glm::vec3 normal = surfaceAt(geometry_, origin_, path_.direction, solid).normal;
        const float length = solid.distance - from;
        return length * std::abs(dot(normal, path_.direction)) < view_.meanRadius &&
               length < kLongestLayer * view_.meanRadius;
    }

    /// Whether metaballs that the ray leaves touch the solid behind.
    bool isInContact(const SolidHit& solid) const {
        return place_.isInMetaballs && !solid.isNone() && isThin(crossing_.distance, solid);
    }

    NextSurface surfaceOfMetaballs() const {
        // Where the ray leaves metaballs, their color does not count.
        if (place_.isInMetaballs) return {crossing_.distance, kHitMetaballs, -crossing_.normal, glm::vec3(0.0F), false};
        return {crossing_.distance, kHitMetaballs, crossing_.normal, colorOfMetaballs(), false};
    }

    /// The mean of a value of the particles at a point of the last crossing.
    template <typename ValueOf>
    glm::vec3 meanAtCrossing(glm::vec3 point, const ValueOf& valueOf) const {
        thread_local std::vector<BallShare> shares;
        if (crossing_.balls == nullptr) return glm::vec3(0.0F);
        findShares(view_.ballCells, *crossing_.balls, point, shares);
        glm::vec3 sum(0.0F);
        float kernels = 0.0F;
        for (const BallShare& share : shares) {
            sum += share.kernel * valueOf(static_cast<std::size_t>(share.particle));
            kernels += share.kernel;
        }
        return kernels > 0.0F ? sum / kernels : glm::vec3(0.0F);
    }

    glm::vec3 colorOfMetaballs() const {
        return meanAtCrossing(origin_ + crossing_.distance * path_.direction,
                              [&](std::size_t k) { return view_.view->particles[k].color; });
    }

    /// Where the ray comes to behind a transparent surface.
    Place placeBeyond(const NextSurface& next) {
        Place beyond;
        beyond.color = next.color;
        layer_ = 0.0F;
        if (next.hitId >= kHitMetaballs) {
            beyond.isInMetaballs = !place_.isInMetaballs;
        } else if (!next.isInner) {
            beyond.mesh = meshOf(next.hitId);
        } else {
            findContact(next, beyond);
        }
        return beyond;
    }

    /// Finds whether metaballs touch the mesh that the ray leaves.
    void findContact(const NextSurface& next, Place& beyond) {
        if (view_.ballCells.empty() || !view_.view->surface.medium.isTransparent()) return;
        const float cosine = std::max(-dot(next.normal, path_.direction), 1.0F / kLongestLayer);
        crossing_ = findCrossing(field_, {origin_, path_.direction, 0.0F, view_.meanRadius / cosine}, false);
        if (crossing_.distance == kNoCrossing) return;
        beyond.isInMetaballs = true;
        beyond.color = colorOfMetaballs();
        layer_ = crossing_.distance + lift_;
    }

    void endAt(const NextSurface& end) {
        path_.hitId = end.hitId;
        path_.position = origin_;
        path_.normal = end.normal;
        path_.color = end.color;
        if (view_.particleSky.empty()) return;
        if (end.hitId >= kHitMetaballs) {
            path_.sky = meanAtCrossing(origin_, [&](std::size_t k) {
                return particleSkyToward(view_.particleSky[k], end.normal, path_.direction);
            });
        } else if (end.hitId >= 0 && end.hitId < geometry_.firstObstacle) {
            const std::size_t particle = view_.drawn.sources[static_cast<std::size_t>(end.hitId)];
            path_.sky = particleSkyToward(view_.particleSky[particle], end.normal, path_.direction);
        }
    }

    const PreparedView& view_;
    const ShadingGeometry& geometry_;
    CastField field_;
    float lift_;  // distance from a surface of metaballs from which the next one is searched for, m
    glm::vec3 origin_{0.0F};
    Place place_;
    float searchFrom_ = 0.0F;  // distance from the origin from which metaballs are searched for, m
    float layer_ = 0.0F;       // length of way through the layer between a mesh and metaballs in contact, m
    SurfacePoint crossing_;
    LightPath path_;
};

}  // namespace

const Medium* mediumOf(const PreparedView& view, std::int32_t hitId) {
    const auto ifTransparent = [](const Medium& medium) { return medium.isTransparent() ? &medium : nullptr; };
    if (hitId >= kHitMetaballs) return ifTransparent(view.view->surface.medium);
    if (hitId < kHitTriangle || hitId >= kHitBox) return nullptr;
    const std::size_t mesh = view.meshes.triangles[static_cast<std::size_t>(hitId - kHitTriangle)].mesh;
    return ifTransparent(view.meshes.obstacles[mesh].medium);
}

LightPath followRay(const PreparedView& view, const ShadingGeometry& geometry, const FirstSurface& first,
                    BallCache& cache) {
    return RayWalk(view, geometry, cache).follow(first);
}

float mirroredShare(float from, float to, float cosine) {
    if (from == to) return 0.0F;
    const float root = (from - to) / (from + to);
    const float headOn = root * root;
    if (from > to) {
        const float ratio = from / to;
        cosine = std::sqrt(std::max(0.0F, 1.0F - ratio * ratio * (1.0F - cosine * cosine)));
    }
    const float away = 1.0F - cosine;
    const float square = away * away;
    return headOn + (1.0F - headOn) * (square * square * away);
}

glm::vec3 surroundingsToward(const Surroundings& around, glm::vec3 direction) {
    const float up = direction.y;
    if (up > 0.0F) return mix(around.horizon, around.top, up * (2.0F - up));
    return mix(around.horizon, around.bottom, std::min(1.0F, -4.0F * up));
}

}  // namespace render
