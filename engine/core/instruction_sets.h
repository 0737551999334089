// Which vectors the kernels run on. Results have the same bits whichever it is; for tests and benchmarks that show so.
#pragma once

#include <string>
#include <vector>

namespace engine {

/// Names of those that this machine has and the kernels are compiled for, the widest first: "AVX3" is AVX-512.
std::vector<std::string> instructionSets();

/// Makes the kernels run on one of them from now on. Shape: while no kernel runs.
/// Throws: std::invalid_argument for any other name.
void useInstructionSet(const std::string& name);

/// As long as it lives, kernels run on one of instructionSets(); then on the widest again.
class OnInstructionSet {
 public:
    explicit OnInstructionSet(const std::string& name) { useInstructionSet(name); }
    ~OnInstructionSet() { useInstructionSet(instructionSets().front()); }
    OnInstructionSet(const OnInstructionSet&) = delete;
    OnInstructionSet& operator=(const OnInstructionSet&) = delete;
};

}  // namespace engine
