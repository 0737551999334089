// Runs what follows on one SIMD instruction set, for tests that compare the results of several.
#pragma once

#include "engine/core/instruction_sets.h"

/// Kernels run on one of engine::instructionSets() during the lifetime of this object, and on the widest again after
/// it.
class OnInstructionSet {
 public:
    explicit OnInstructionSet(const std::string& name) { engine::useInstructionSet(name); }
    ~OnInstructionSet() { engine::useInstructionSet(engine::instructionSets().front()); }
    OnInstructionSet(const OnInstructionSet&) = delete;
    OnInstructionSet& operator=(const OnInstructionSet&) = delete;
};
