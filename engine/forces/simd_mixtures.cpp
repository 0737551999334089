// The SIMD kernels for particles of several laws or radii, compiled once per instruction set. They are apart from the
// kernels for one law because each of the two files takes long to compile.
#include "engine/forces/simd_forces.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_mixtures.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

ClusterKernel mixedKernelHere(const PairTraversal& pairs, const PairSums& wanted) {
    return kernelFor<MixedLaws>(pairs, wanted);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(mixedKernelHere);

ClusterKernel mixedClusterKernel(const PairTraversal& pairs, const PairSums& wanted) {
    return HWY_DYNAMIC_DISPATCH(mixedKernelHere)(pairs, wanted);
}

}  // namespace engine

#endif
