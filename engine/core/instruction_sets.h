// Which SIMD instruction set the kernels run on. The results have the same bits on any; tests and benchmarks choose one
// to show that.
#pragma once

#include <string>
#include <vector>

namespace engine {

/// Names of the instruction sets that this machine has and the kernels are compiled for, the widest first; "AVX3" is
/// AVX-512.
std::vector<std::string> instructionSets();

/// Makes the kernels run on one of them from now on. Must not be called while a kernel runs.
/// @throws std::invalid_argument for any other name
void useInstructionSet(const std::string& name);

/// Kernels run on one of instructionSets() during the lifetime of this object, and on the widest again after it.
class OnInstructionSet {
 public:
    explicit OnInstructionSet(const std::string& name) { useInstructionSet(name); }
    ~OnInstructionSet() { useInstructionSet(instructionSets().front()); }
    OnInstructionSet(const OnInstructionSet&) = delete;
    OnInstructionSet& operator=(const OnInstructionSet&) = delete;
};

}  // namespace engine
