// Vectors of three coordinates over lanes. Included once per instruction set, by Highway's rules; the guard below is
// theirs.
#if defined(ENGINE_LANE_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_LANE_VECTORS_INL_H
#undef ENGINE_LANE_VECTORS_INL_H
#else
#define ENGINE_LANE_VECTORS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vector3 {
    V x, y, z;
};

template <class V>
Vector3<V> difference(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
V dot(const Vector3<V>& a, const Vector3<V>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
