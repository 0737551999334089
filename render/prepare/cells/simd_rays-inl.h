// Vector arithmetic on SIMD lanes and the rays of a camera, shared by the kernels that are compiled once per
// instruction set. A lane is one ray, point or particle. Included by Highway's rules, from which the guard below comes.
#if defined(RENDER_SIMD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_RAYS_INL_H_
#undef RENDER_SIMD_RAYS_INL_H_
#else
#define RENDER_SIMD_RAYS_INL_H_
#endif

#include <array>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "render/picture/camera_frame.h"
#include "render/prepare/cells/tiles.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Vectors of floats, of integers, and masks. At most as many lanes as a tile has columns.
using D = hn::CappedTag<float, kTileSize>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

struct Vec3 {
    V x, y, z;
};

HWY_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

HWY_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Product component by component.
HWY_INLINE Vec3 operator*(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

HWY_INLINE Vec3 operator*(const Vec3& a, V factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
}

HWY_INLINE V splat(float value) {
    return hn::Set(D(), value);
}

HWY_INLINE VI splatInt(std::int32_t value) {
    return hn::Set(DI(), value);
}

HWY_INLINE Vec3 splat(glm::vec3 v) {
    return {splat(v.x), splat(v.y), splat(v.z)};
}

// Pointers for load, loadInt, store and storeInt have to be aligned for vectors.
HWY_INLINE V load(const float* values) {
    return hn::Load(D(), values);
}

HWY_INLINE VI loadInt(const std::int32_t* values) {
    return hn::Load(DI(), values);
}

HWY_INLINE void store(V value, float* to) {
    hn::Store(value, D(), to);
}

HWY_INLINE void storeInt(VI value, std::int32_t* to) {
    hn::Store(value, DI(), to);
}

/// Whether the mask is false in all lanes.
HWY_INLINE bool none(M mask) {
    return hn::AllFalse(D(), mask);
}

HWY_INLINE V dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HWY_INLINE Vec3 normalize(const Vec3& v) {
    return v * (splat(1.0F) / hn::Sqrt(dot(v, v)));
}

/// Loads the vectors of a tile's entries first, first + 1, ..., one per lane.
HWY_INLINE Vec3 loadVec3(const TileVec3& values, std::size_t first) {
    return {load(&values[0][first]), load(&values[1][first]), load(&values[2][first])};
}

HWY_INLINE void storeVec3(const Vec3& v, TileVec3& values, std::size_t first) {
    store(v.x, &values[0][first]);
    store(v.y, &values[1][first]);
    store(v.z, &values[2][first]);
}

HWY_INLINE Vec3 select(M mask, const Vec3& yes, const Vec3& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE Vec3 pointOnRay(const Vec3& origin, V t, const Vec3& direction) {
    return origin + direction * t;
}

HWY_INLINE V clamp(V value, float low, float high) {
    return hn::Min(hn::Max(value, splat(low)), splat(high));
}

/// Converts a mask of integers to one of floats.
HWY_INLINE M floatMask(hn::Mask<DI> mask) {
    return hn::RebindMask(D(), mask);
}

/// The minimum over the lanes of a mask, in every lane; the largest float if the mask has none.
HWY_INLINE V minOfLanes(V values, M lanes) {
    return hn::MinOfLanes(D(), hn::IfThenElse(lanes, values, splat(std::numeric_limits<float>::max())));
}

/// A mask as one bit for each lane, the first lane in the lowest bit.
HWY_INLINE std::uint32_t maskBits(M mask) {
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(D(), mask, bytes.data());
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
}

/// View coordinates x and y at which the rays through points of the picture cross the plane at view depth 1 (any depth
/// in parallel projection), m.
struct ImagePoint {
    V x, y;
};

HWY_INLINE ImagePoint imagePointAt(const CameraFrame& frame, V x, V y) {
    const V one = splat(1.0F);
    return {
        (x * splat(2.0F / static_cast<float>(frame.width)) - one) * splat(frame.halfWidth) + splat(frame.middle.x),
        (one - y * splat(2.0F / static_cast<float>(frame.height))) * splat(frame.halfHeight) + splat(frame.middle.y)};
}

/// The component of a ray's direction along `forward` is 1, so that the parameter of the ray is the view depth.
struct Ray {
    Vec3 origin, direction;
};

/// The rays through points of the picture in world axes, relative to the eye.
HWY_INLINE Ray worldRay(const CameraFrame& frame, const ImagePoint& at) {
    const Vec3 off = splat(frame.right) * at.x + splat(frame.up) * at.y;
    if (!frame.perspective) return {off, splat(frame.forward)};
    return {splat(glm::vec3(0.0F)), splat(frame.forward) + off};
}

/// The rays through points of the picture in view coordinates.
HWY_INLINE Ray viewRay(const CameraFrame& frame, const ImagePoint& at) {
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    if (frame.perspective) return {{zero, zero, zero}, {at.x, at.y, one}};
    return {{at.x, at.y, zero}, {zero, zero, one}};
}

/// Converts a vector from view coordinates to world axes.
HWY_INLINE Vec3 toWorld(const CameraFrame& frame, const Vec3& v) {
    return splat(frame.right) * v.x + splat(frame.up) * v.y + splat(frame.forward) * v.z;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
