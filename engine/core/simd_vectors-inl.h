// Arithmetic on SIMD vectors: three-component vectors with a vector for each coordinate, and the functions that the
// formulas of engine/force_law need. Highway includes this file once per instruction set, hence the unusual include
// guard below.
#if defined(ENGINE_SIMD_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_VECTORS_INL_H
#undef ENGINE_SIMD_VECTORS_INL_H
#else
#define ENGINE_SIMD_VECTORS_INL_H
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
HWY_INLINE Vector3<V> difference(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE Vector3<V> scaled(V factor, const Vector3<V>& vector) {
    return {hn::Mul(factor, vector.x), hn::Mul(factor, vector.y), hn::Mul(factor, vector.z)};
}

/// sum += factor * vector
template <class V>
HWY_INLINE void addScaled(Vector3<V>& sum, V factor, const Vector3<V>& vector) {
    sum.x = hn::Add(sum.x, hn::Mul(factor, vector.x));
    sum.y = hn::Add(sum.y, hn::Mul(factor, vector.y));
    sum.z = hn::Add(sum.z, hn::Mul(factor, vector.z));
}

/// Dot product, summed x, y, z in that order like engine::dot().
template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

// The functions that force_law/pair_force-inl.h needs, for SIMD vectors. force_law/pair_law.h has the same functions
// for plain numbers.
template <class V>
HWY_INLINE V larger(V a, V b) {
    return hn::Max(a, b);
}
template <class V>
HWY_INLINE V atLeast(V number, double bound) {
    return hn::Max(number, hn::Set(hn::DFromV<V>(), static_cast<hn::TFromV<V>>(bound)));
}
template <class V>
HWY_INLINE V atMost(V number, double bound) {
    return hn::Min(number, hn::Set(hn::DFromV<V>(), static_cast<hn::TFromV<V>>(bound)));
}
template <class V>
HWY_INLINE V times(double factor, V number) {
    return hn::Mul(hn::Set(hn::DFromV<V>(), static_cast<hn::TFromV<V>>(factor)), number);
}
template <class V>
HWY_INLINE V lessFrom(double from, V number) {
    return hn::Sub(hn::Set(hn::DFromV<V>(), static_cast<hn::TFromV<V>>(from)), number);
}
template <class V>
HWY_INLINE V positivePart(V number) {
    return hn::Max(number, hn::Zero(hn::DFromV<V>()));
}
template <class V>
HWY_INLINE V reciprocal(V number) {
    return hn::Div(hn::Set(hn::DFromV<V>(), hn::TFromV<V>(1)), number);
}
template <class V>
HWY_INLINE V squareRoot(V number) {
    return hn::Sqrt(number);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
