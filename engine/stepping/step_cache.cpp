// Copying and invalidating the step cache.
#include "engine/stepping/step_cache.h"

namespace engine {

void StepCache::invalidate() {
    forcesCurrent = false;
    energy.reset();
    clearance.clear();
    cachedNeighbors.clear();
    evaluator.forgetList();
    evaluator.setGroups({});
    groupEnergies.clear();
    meanAccelerations.clear();
}

StepCachePointer::StepCachePointer() : cache_(std::make_unique<StepCache>()) {}
StepCachePointer::StepCachePointer(const StepCachePointer& other) : cache_(std::make_unique<StepCache>(*other)) {}
StepCachePointer::StepCachePointer(StepCachePointer&& other) noexcept = default;
StepCachePointer& StepCachePointer::operator=(const StepCachePointer& other) {
    if (!cache_) cache_ = std::make_unique<StepCache>();
    *cache_ = *other;  // reuses the memory of the present cache
    return *this;
}
StepCachePointer& StepCachePointer::operator=(StepCachePointer&& other) noexcept = default;
StepCachePointer::~StepCachePointer() = default;

}  // namespace engine
