// The SIMD kernels for particles of one law and one radius, compiled once per instruction set, and the choice among all
// SIMD kernels.
#include "engine/forces/simd_forces.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

ClusterKernel uniformKernelHere(const PairTraversal& pairs, const PairSums& wanted) {
    return kernelFor<OneLaw>(pairs, wanted);
}

const char* instructionSetHere() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(uniformKernelHere);
HWY_EXPORT(instructionSetHere);

ClusterKernel clusterKernel(const PairTraversal& pairs, const PairSums& wanted) {
    if (!pairs.terms.uniform()) return mixedClusterKernel(pairs, wanted);
    return HWY_DYNAMIC_DISPATCH(uniformKernelHere)(pairs, wanted);
}

const char* simdInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace engine

#endif
