// Counts strays and puts the warning into words.
#include "tools/run/stray_warning.h"

#include <fmt/format.h>

#include "engine/run/strays.h"
#include "tools/system/process.h"

namespace tools {

std::string strayWarning(std::uint64_t count) {
    return fmt::format(
        "{} and will be computed until the run ends; a [world] with bounds removes them",
        count == 1 ? "a particle has left the scene" : fmt::format("{} particles have left the scene", count));
}

void warnOfStrays(const engine::Simulation& simulation) {
    const std::uint64_t count = engine::strayCount(simulation);
    if (count > 0) printWarning(strayWarning(count));
}

}  // namespace tools
