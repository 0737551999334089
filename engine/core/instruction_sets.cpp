// Highway represents its targets as bits, the widest target as the lowest bit, and chooses among those that are marked
// as supported.
#include "engine/core/instruction_sets.h"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <stdexcept>

namespace engine {
namespace {

/// Highway's targets (instruction sets) that this machine supports and that were compiled. Read once, before a target
/// is chosen, since the choice hides the other targets.
std::int64_t available() {
    static const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    return targets;
}

}  // namespace

std::vector<std::string> instructionSets() {
    std::vector<std::string> names;
    for (std::int64_t rest = available(); rest != 0; rest &= rest - 1) names.push_back(hwy::TargetName(rest & -rest));
    return names;
}

void useInstructionSet(const std::string& name) {
    for (std::int64_t rest = available(); rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        if (hwy::TargetName(target) != name) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        return;
    }
    throw std::invalid_argument("no kernels for " + name + " here");
}

}  // namespace engine
