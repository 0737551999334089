// Which SIMD instruction set the kernels run on. The results have the same bits on every one; tests and benchmarks
// choose one to show that.
#pragma once

#include <string>
#include <vector>

namespace engine {

/// Names of the instruction sets that this machine has and that the kernels are compiled for, the widest first. They
/// are Highway's names, for example "AVX2" and, for AVX-512, "AVX3".
std::vector<std::string> instructionSets();

/// Makes all kernels run on the instruction set of this name from now on. Must not be called while a kernel runs.
/// @throws std::invalid_argument for any other name
void useInstructionSet(const std::string& name);

}  // namespace engine
