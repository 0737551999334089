// Exact intersections with Highway, one ray per lane; this file is compiled once per instruction set.
//
// Spheres and boxes are solid: a ray that starts inside one hits it at depth 0. Of two hits at the same depth the one
// with the lesser id counts if they are of the ground and boxes, and otherwise the one that was found first.
#include "render/cpu/raster/primary_hits.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/primary_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The nearest hits of a vector of rays so far.
struct NearestHits {
    V depth;
    VI id;

    void add(V newDepth, VI newId) { replace(newDepth < depth, newDepth, newId); }

    /// Adds hits that may be as near as others, in any order.
    void addInAnyOrder(V newDepth, VI newId) {
        const M isLess = hn::RebindMask(D(), newId < id);
        replace(hn::Or(newDepth < depth, hn::And(newDepth == depth, isLess)), newDepth, newId);
    }

 private:
    void replace(M isNearer, V newDepth, VI newId) {
        depth = hn::IfThenElse(isNearer, newDepth, depth);
        id = hn::IfThenElse(hn::RebindMask(DI(), isNearer), newId, id);
    }
};

Ray rayAt(const SolidGeometry& geometry, const TileRays& rays, std::size_t first) {
    return worldRay(geometry.frame, imagePointAt(geometry.frame, load(&rays.x[first]), load(&rays.y[first])));
}

V depthOfGround(const Ray& ray, float height) {
    const V depth = (splat(height) - ray.origin.y) / ray.direction.y;
    const M isHit = hn::And(depth > splat(0.0F), depth < splat(kFarDepth));
    return hn::IfThenElse(isHit, depth, splat(kFarDepth));
}

/// A ray against one pair of a box's faces.
struct Slab {
    V near, far;      // view depths at which the ray enters and leaves the slab between the two faces, m
    V toLow, toHigh;  // distances of the ray's start from the faces, m
    VI entered;       // face that the ray meets first, as in a hit id
    VI nearest;       // face that the ray's start is nearest to, as in a hit id
};

Slab slabOf(V origin, V direction, float low, float high, int axis) {
    const V least = splat(1.0e-20F);
    const V slope = hn::IfThenElse(hn::Abs(direction) > least, direction, least);
    Slab slab;
    const V first = (splat(low) - origin) / slope;
    const V second = (splat(high) - origin) / slope;
    slab.near = hn::Min(first, second);
    slab.far = hn::Max(first, second);
    slab.toLow = origin - splat(low);
    slab.toHigh = splat(high) - origin;
    const VI plus = splatInt(2 * axis);
    const VI minus = splatInt(2 * axis + 1);
    slab.entered = hn::IfThenElse(hn::RebindMask(DI(), slope > splat(0.0F)), minus, plus);
    slab.nearest = hn::IfThenElse(hn::RebindMask(DI(), slab.toLow < slab.toHigh), minus, plus);
    return slab;
}

V minOf(V a, V b, V c) {
    return hn::Min(a, hn::Min(b, c));
}

/// The integer that belongs to the first of three axes whose value equals `wanted`.
VI ofAxis(V wanted, V x, V y, VI ofX, VI ofY, VI ofZ) {
    const DI di;
    return hn::IfThenElse(hn::RebindMask(di, x == wanted), ofX,
                          hn::IfThenElse(hn::RebindMask(di, y == wanted), ofY, ofZ));
}

void addBox(const Ray& ray, const BoxObstacle& box, glm::vec3 eye, std::int32_t id, NearestHits& hits) {
    const glm::vec3 low = box.minimum - eye;
    const glm::vec3 high = box.maximum - eye;
    const Slab x = slabOf(ray.origin.x, ray.direction.x, low.x, high.x, 0);
    const Slab y = slabOf(ray.origin.y, ray.direction.y, low.y, high.y, 1);
    const Slab z = slabOf(ray.origin.z, ray.direction.z, low.z, high.z, 2);
    const V entry = hn::Max(x.near, hn::Max(y.near, z.near));
    const V exit = minOf(x.far, y.far, z.far);
    const V zero = splat(0.0F);
    const M isHit = hn::And(entry <= exit, exit >= zero);
    const VI entered = ofAxis(entry, x.near, y.near, x.entered, y.entered, z.entered);
    // A ray that starts inside the box sees the face that is nearest to its start.
    const V gapX = hn::Min(x.toLow, x.toHigh);
    const V gapY = hn::Min(y.toLow, y.toHigh);
    const V nearest = minOf(gapX, gapY, hn::Min(z.toLow, z.toHigh));
    const VI around = ofAxis(nearest, gapX, gapY, x.nearest, y.nearest, z.nearest) + splatInt(8);
    const VI face = hn::IfThenElse(hn::RebindMask(DI(), entry >= zero), entered, around);
    hits.addInAnyOrder(hn::IfThenElse(isHit, hn::Max(entry, zero), splat(kFarDepth)), face + splatInt(id));
}

void findFlatHits(const SolidGeometry& geometry, FlatGeometry flats, TileRays& rays) {
    const D d;
    for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(d)) {
        const Ray ray = rayAt(geometry, rays, first);
        NearestHits hits{splat(kFarDepth), splatInt(kHitBackground)};
        if (flats.hasGround && geometry.ground) hits.add(depthOfGround(ray, *geometry.ground), splatInt(kHitGround));
        for (const std::uint32_t box : flats.boxes) {
            // All later boxes are behind what has been hit.
            if (hn::AllTrue(d, hits.depth < splat(geometry.boxFronts[box]))) break;
            addBox(ray, geometry.boxes[box], geometry.frame.eye, kHitBox + 16 * static_cast<std::int32_t>(box), hits);
        }
        store(hits.depth, &rays.depth[first]);
        storeInt(hits.id, &rays.hitId[first]);
    }
}

/// The rays of a tile's samples as the intersection with spheres needs them: positions x and y on the plane at view
/// depth 1, and inverseSquare = 1 / (x^2 + y^2 + 1).
struct SphereRays {
    alignas(64) std::array<std::array<float, kTilePixels>, 4> x, y, inverseSquare;
    alignas(64) std::array<float, kTilePixels> farthest;  ///< the greatest depth of a pixel's samples so far

    SphereRays(const CameraFrame& frame, std::span<const TileRays> samples) {
        const D d;
        const V one = splat(1.0F);
        for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(d)) {
            V most = splat(0.0F);
            for (std::size_t s = 0; s < samples.size(); ++s) {
                const ImagePoint at = imagePointAt(frame, load(&samples[s].x[first]), load(&samples[s].y[first]));
                store(at.x, &x[s][first]);
                store(at.y, &y[s][first]);
                store(one / (at.x * at.x + at.y * at.y + one), &inverseSquare[s][first]);
                most = hn::Max(most, load(&samples[s].depth[first]));
            }
            store(most, &farthest[first]);
        }
    }

    float farthestOfTile() const {
        const D d;
        V most = load(farthest.data());
        for (std::size_t first = hn::Lanes(d); first < kTilePixels; first += hn::Lanes(d))
            most = hn::Max(most, load(&farthest[first]));
        return hn::GetLane(hn::MaxOfLanes(d, most));
    }
};

/// Adds one sphere to one vector of rays of sample s. The intersection is measured from the point of the ray that is
/// closest to the center, so that nothing cancels, however far away the sphere is.
template <bool kPerspective>
void addSphere(const ViewSphere& sphere, std::int32_t id, const SphereRays& rays, std::size_t s, std::size_t first,
               TileRays& sample) {
    const V x = load(&rays.x[s][first]);
    const V y = load(&rays.y[s][first]);
    const Vec3 center = splat(sphere.center);
    V closest = center.z;
    V square;
    if constexpr (kPerspective) {
        const V inverse = load(&rays.inverseSquare[s][first]);
        closest = (center.x * x + center.y * y + center.z) * inverse;
        const Vec3 off{center.x - closest * x, center.y - closest * y, center.z - closest};
        square = dot(off, off);
    } else {
        const V offX = center.x - x;
        const V offY = center.y - y;
        square = offX * offX + offY * offY;
    }
    const V zero = splat(0.0F);
    const V inside = splat(sphere.radius * sphere.radius) - square;
    M isHit = inside > zero;
    if (none(isHit)) return;
    V halfSquare = hn::Max(inside, zero);
    if constexpr (kPerspective) halfSquare = halfSquare * load(&rays.inverseSquare[s][first]);
    const V halfChord = hn::Sqrt(halfSquare);
    isHit = hn::And(isHit, closest + halfChord >= zero);
    const V depth = hn::Max(closest - halfChord, zero);
    NearestHits hits{load(&sample.depth[first]), loadInt(&sample.hitId[first])};
    hits.add(hn::IfThenElse(isHit, depth, splat(kFarDepth)), splatInt(id));
    store(hits.depth, &sample.depth[first]);
    storeInt(hits.id, &sample.hitId[first]);
}

template <bool kPerspective>
void addSpheres(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    const D d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    SphereRays rays(geometry.frame, samples);
    const glm::ivec2 corner(tileCorner(*geometry.tiles, tile));
    for (const std::uint32_t index : geometry.tiles->itemsOf(tile)) {
        const ViewSphere& sphere = geometry.spheres[index];
        const float front = sphere.center.z - sphere.radius;
        // The spheres are listed front to back: all later ones are behind what has been hit.
        if (front > rays.farthestOfTile()) break;
        const Rect touched = withinTile(geometry.pixels[index], corner.x, corner.y);
        for (int row = touched.y0; row <= touched.y1; ++row) {
            for (int column = touched.x0 / lanes * lanes; column <= touched.x1; column += lanes) {
                const auto first = static_cast<std::size_t>(row * kTileSize + column);
                if (hn::AllTrue(d, load(&rays.farthest[first]) < splat(front))) continue;
                V most = splat(0.0F);
                for (std::size_t s = 0; s < samples.size(); ++s) {
                    addSphere<kPerspective>(sphere, static_cast<std::int32_t>(index), rays, s, first, samples[s]);
                    most = hn::Max(most, load(&samples[s].depth[first]));
                }
                store(most, &rays.farthest[first]);
            }
        }
    }
}

void findSphereHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    geometry.frame.perspective ? addSpheres<true>(geometry, tile, samples) : addSpheres<false>(geometry, tile, samples);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(findFlatHits);
HWY_EXPORT(findSphereHits);

void findFlatHits(const SolidGeometry& geometry, FlatGeometry flats, TileRays& rays) {
    HWY_DYNAMIC_DISPATCH(findFlatHits)(geometry, flats, rays);
}

void findSphereHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(findSphereHits)(geometry, tile, samples);
}

}  // namespace render

#endif
