// Exact intersections with Highway, one ray per lane; this file is compiled once per instruction set.
//
// Spheres and boxes are solid: a ray that starts inside one meets it at depth 0. Of two things at the same depth the
// one that was looked at first is seen.
#include "render/cpu/raster/primary_hits.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/primary_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// What a group of rays sees so far.
struct Seen {
    V depth;
    VI what;

    void add(V at, VI id) {
        const M nearer = hn::Lt(at, depth);
        depth = hn::IfThenElse(nearer, at, depth);
        what = hn::IfThenElse(hn::RebindMask(DI(), nearer), id, what);
    }
};

V depthOfGround(const WorldRay& ray, float height) {
    const D d;
    const V depth = hn::Div(hn::Sub(hn::Set(d, height), ray.origin.y), ray.direction.y);
    const M isHit = hn::And(hn::Gt(depth, hn::Zero(d)), hn::Lt(depth, hn::Set(d, kFarDepth)));
    return hn::IfThenElse(isHit, depth, hn::Set(d, kFarDepth));
}

/// One pair of a box' faces along a ray.
struct Slab {
    V near, far;      // view depths
    V toLow, toHigh;  // distances of the ray's start from the faces
    VI entered;       // face that the ray meets first
    VI nearest;       // face that its start is nearest to
};

Slab slabOf(V origin, V direction, float low, float high, int axis) {
    const D d;
    const DI di;
    const V least = hn::Set(d, 1.0e-20F);
    const V slope = hn::IfThenElse(hn::Gt(hn::Abs(direction), least), direction, least);
    Slab slab;
    const V first = hn::Div(hn::Sub(hn::Set(d, low), origin), slope);
    const V second = hn::Div(hn::Sub(hn::Set(d, high), origin), slope);
    slab.near = hn::Min(first, second);
    slab.far = hn::Max(first, second);
    slab.toLow = hn::Sub(origin, hn::Set(d, low));
    slab.toHigh = hn::Sub(hn::Set(d, high), origin);
    const VI plus = hn::Set(di, 2 * axis);
    const VI minus = hn::Set(di, 2 * axis + 1);
    slab.entered = hn::IfThenElse(hn::RebindMask(di, hn::Gt(slope, hn::Zero(d))), minus, plus);
    slab.nearest = hn::IfThenElse(hn::RebindMask(di, hn::Lt(slab.toLow, slab.toHigh)), minus, plus);
    return slab;
}

V least(V a, V b, V c) {
    return hn::Min(a, hn::Min(b, c));
}

/// What belongs to the first axis whose value is the wanted one.
VI ofAxis(V wanted, V x, V y, VI ofX, VI ofY, VI ofZ) {
    const DI di;
    return hn::IfThenElse(hn::RebindMask(di, hn::Eq(x, wanted)), ofX,
                          hn::IfThenElse(hn::RebindMask(di, hn::Eq(y, wanted)), ofY, ofZ));
}

void addBox(const WorldRay& ray, const BoxObstacle& box, glm::vec3 eye, std::int32_t id, Seen& seen) {
    const D d;
    const DI di;
    const glm::vec3 low = box.minimum - eye;
    const glm::vec3 high = box.maximum - eye;
    const Slab x = slabOf(ray.origin.x, ray.direction.x, low.x, high.x, 0);
    const Slab y = slabOf(ray.origin.y, ray.direction.y, low.y, high.y, 1);
    const Slab z = slabOf(ray.origin.z, ray.direction.z, low.z, high.z, 2);
    const V entry = hn::Max(x.near, hn::Max(y.near, z.near));
    const V exit = least(x.far, y.far, z.far);
    const V zero = hn::Zero(d);
    const M isHit = hn::And(hn::Le(entry, exit), hn::Ge(exit, zero));
    const VI entered = ofAxis(entry, x.near, y.near, x.entered, y.entered, z.entered);
    // From inside, the nearest face is the one that is seen.
    const V ofX = hn::Min(x.toLow, x.toHigh);
    const V ofY = hn::Min(y.toLow, y.toHigh);
    const V nearest = least(ofX, ofY, hn::Min(z.toLow, z.toHigh));
    const VI around = hn::Add(ofAxis(nearest, ofX, ofY, x.nearest, y.nearest, z.nearest), hn::Set(di, 8));
    const VI face = hn::IfThenElse(hn::RebindMask(di, hn::Ge(entry, zero)), entered, around);
    seen.add(hn::IfThenElse(isHit, hn::Max(entry, zero), hn::Set(d, kFarDepth)), hn::Add(face, hn::Set(di, id)));
}

void lookAtFlats(const Solids& solids, Flats flats, TileRays& rays) {
    const D d;
    const DI di;
    for (std::size_t place = 0; place < kTilePixels; place += hn::Lanes(d)) {
        const WorldRay ray = worldRay(
            solids.frame, imagePointAt(solids.frame, hn::Load(d, &rays.x[place]), hn::Load(d, &rays.y[place])));
        Seen seen{hn::Set(d, kFarDepth), hn::Set(di, kSeesBackground)};
        if (flats.ground && solids.ground) seen.add(depthOfGround(ray, *solids.ground), hn::Set(di, kSeesGround));
        if (flats.boxes) {
            std::int32_t id = kSeesBox;
            for (const BoxObstacle& box : solids.boxes) {
                addBox(ray, box, solids.frame.eye, id, seen);
                id += 16;
            }
        }
        hn::Store(seen.depth, d, &rays.depth[place]);
        hn::Store(seen.what, di, &rays.seen[place]);
    }
}

/// The rays of a tile's samples, as spheres need them.
struct SphereRays {
    alignas(64) std::array<std::array<float, kTilePixels>, 4> x, y, inverseSquare;
    alignas(64) std::array<float, kTilePixels> farthest;  ///< of a pixel's samples

    SphereRays(const CameraFrame& frame, std::span<const TileRays> samples) {
        const D d;
        const V one = hn::Set(d, 1.0F);
        for (std::size_t place = 0; place < kTilePixels; place += hn::Lanes(d)) {
            V most = hn::Zero(d);
            for (std::size_t s = 0; s < samples.size(); ++s) {
                const ImagePoint at =
                    imagePointAt(frame, hn::Load(d, &samples[s].x[place]), hn::Load(d, &samples[s].y[place]));
                hn::Store(at.x, d, &x[s][place]);
                hn::Store(at.y, d, &y[s][place]);
                const V square = hn::Add(hn::Add(hn::Mul(at.x, at.x), hn::Mul(at.y, at.y)), one);
                hn::Store(hn::Div(one, square), d, &inverseSquare[s][place]);
                most = hn::Max(most, hn::Load(d, &samples[s].depth[place]));
            }
            hn::Store(most, d, &farthest[place]);
        }
    }

    float mostOfAll() const {
        const D d;
        V most = hn::Load(d, farthest.data());
        for (std::size_t place = hn::Lanes(d); place < kTilePixels; place += hn::Lanes(d))
            most = hn::Max(most, hn::Load(d, &farthest[place]));
        return hn::GetLane(hn::MaxOfLanes(d, most));
    }
};

/// Measured from the point of the ray that is closest to the center: no cancellation, however far the sphere.
template <bool kPerspective>
void addSphere(const ViewSphere& sphere, std::int32_t id, const SphereRays& rays, std::size_t s, std::size_t place,
               TileRays& sample) {
    const D d;
    const DI di;
    const V x = hn::Load(d, &rays.x[s][place]);
    const V y = hn::Load(d, &rays.y[s][place]);
    const V cx = hn::Set(d, sphere.center.x);
    const V cy = hn::Set(d, sphere.center.y);
    const V cz = hn::Set(d, sphere.center.z);
    V closest = cz;
    V square;
    if constexpr (kPerspective) {
        const V inverse = hn::Load(d, &rays.inverseSquare[s][place]);
        closest = hn::Mul(hn::Add(hn::Add(hn::Mul(cx, x), hn::Mul(cy, y)), cz), inverse);
        const V offX = hn::Sub(cx, hn::Mul(closest, x));
        const V offY = hn::Sub(cy, hn::Mul(closest, y));
        const V offZ = hn::Sub(cz, closest);
        square = hn::Add(hn::Add(hn::Mul(offX, offX), hn::Mul(offY, offY)), hn::Mul(offZ, offZ));
    } else {
        const V offX = hn::Sub(cx, x);
        const V offY = hn::Sub(cy, y);
        square = hn::Add(hn::Mul(offX, offX), hn::Mul(offY, offY));
    }
    const V zero = hn::Zero(d);
    const V inside = hn::Sub(hn::Set(d, sphere.radius * sphere.radius), square);
    M isHit = hn::Gt(inside, zero);
    if (hn::AllFalse(d, isHit)) return;
    V halfSquare = hn::Max(inside, zero);
    if constexpr (kPerspective) halfSquare = hn::Mul(halfSquare, hn::Load(d, &rays.inverseSquare[s][place]));
    const V halfChord = hn::Sqrt(halfSquare);
    isHit = hn::And(isHit, hn::Ge(hn::Add(closest, halfChord), zero));
    const V depth = hn::Max(hn::Sub(closest, halfChord), zero);
    Seen seen{hn::Load(d, &sample.depth[place]), hn::Load(di, &sample.seen[place])};
    seen.add(hn::IfThenElse(isHit, depth, hn::Set(d, kFarDepth)), hn::Set(di, id));
    hn::Store(seen.depth, d, &sample.depth[place]);
    hn::Store(seen.what, di, &sample.seen[place]);
}

/// Pixels of a tile, from its corner.
Rect withinTile(const Rect& pixels, int left, int top) {
    return {std::max(pixels.x0 - left, 0), std::max(pixels.y0 - top, 0), std::min(pixels.x1 - left, kTileSize - 1),
            std::min(pixels.y1 - top, kTileSize - 1)};
}

/// Returns a height over the eye that those that were looked at do not reach under.
template <bool kPerspective>
float addSpheres(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    const D d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    SphereRays rays(solids.frame, samples);
    const auto columns = static_cast<std::size_t>(solids.tiles->columns);
    const int left = static_cast<int>(tile % columns) * kTileSize;
    const int top = static_cast<int>(tile / columns) * kTileSize;
    const glm::vec3 upwards(solids.frame.right.y, solids.frame.up.y, solids.frame.forward.y);
    float lowest = kFarDepth;
    constexpr float kRounding = 1e-6F;  // of a center's height, as a share of its distance
    for (std::size_t k = solids.tiles->begin[tile]; k < solids.tiles->begin[tile + 1]; ++k) {
        const std::uint32_t index = solids.tiles->items[k];
        const ViewSphere& sphere = solids.spheres[index];
        const float front = sphere.center.z - sphere.radius;
        // Front to back: what comes later on the list is behind what is already seen.
        if (front > rays.mostOfAll()) break;
        const glm::vec3 off = abs(sphere.center);
        const float rounding = kRounding * (off.x + off.y + off.z);
        lowest = std::min(lowest, dot(sphere.center, upwards) - sphere.radius - rounding);
        const Rect touched = withinTile(solids.pixels[index], left, top);
        for (int row = touched.y0; row <= touched.y1; ++row) {
            for (int column = touched.x0 / lanes * lanes; column <= touched.x1; column += lanes) {
                const auto place = static_cast<std::size_t>(row * kTileSize + column);
                if (hn::AllTrue(d, hn::Lt(hn::Load(d, &rays.farthest[place]), hn::Set(d, front)))) continue;
                V most = hn::Zero(d);
                for (std::size_t s = 0; s < samples.size(); ++s) {
                    addSphere<kPerspective>(sphere, static_cast<std::int32_t>(index), rays, s, place, samples[s]);
                    most = hn::Max(most, hn::Load(d, &samples[s].depth[place]));
                }
                hn::Store(most, d, &rays.farthest[place]);
            }
        }
    }
    return lowest;
}

float addSpheresOf(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    return solids.frame.perspective ? addSpheres<true>(solids, tile, samples)
                                    : addSpheres<false>(solids, tile, samples);
}

void lookAtSpheres(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    addSpheresOf(solids, tile, samples);
}

/// The ground hides what lies behind it.
void hideBehindGround(const Solids& solids, float height, TileRays& rays) {
    const D d;
    const DI di;
    for (std::size_t place = 0; place < kTilePixels; place += hn::Lanes(d)) {
        const ImagePoint at = imagePointAt(solids.frame, hn::Load(d, &rays.x[place]), hn::Load(d, &rays.y[place]));
        const M isNearer = hn::Le(depthOfGround(worldRay(solids.frame, at), height), hn::Load(d, &rays.depth[place]));
        const VI seen = hn::Load(di, &rays.seen[place]);
        hn::Store(hn::IfThenElse(hn::RebindMask(di, isNearer), hn::Set(di, kSeesGround), seen), di, &rays.seen[place]);
    }
}

void lookAtSpheresOnGround(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    for (TileRays& rays : samples) {
        rays.depth.fill(kFarDepth);
        rays.seen.fill(kSeesGround);
    }
    const float lowest = addSpheresOf(solids, tile, samples);
    const float ground = solids.ground.value_or(0.0F);
    // Seen from below, the ground hides what stands on it; in parallel projection rays begin on both sides of it.
    const bool isFromAbove = solids.frame.perspective ? ground < 0.0F : solids.frame.forward.y < 0.0F;
    if (isFromAbove && lowest > ground) return;
    for (TileRays& rays : samples) hideBehindGround(solids, ground, rays);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(lookAtFlats);
HWY_EXPORT(lookAtSpheres);
HWY_EXPORT(lookAtSpheresOnGround);

void lookAtFlats(const Solids& solids, Flats flats, TileRays& rays) {
    HWY_DYNAMIC_DISPATCH(lookAtFlats)(solids, flats, rays);
}

void lookAtSpheres(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(lookAtSpheres)(solids, tile, samples);
}

void lookAtSpheresOnGround(const Solids& solids, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(lookAtSpheresOnGround)(solids, tile, samples);
}

}  // namespace render

#endif
