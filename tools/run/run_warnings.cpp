// Counts what went softly wrong and puts it into words.
#include "tools/run/run_warnings.h"

#include <fmt/format.h>

#include "engine/run/strays.h"
#include "tools/run/emission_report.h"
#include "tools/system/process.h"

namespace tools {
namespace {

/// The mean error that the automatic stepper reports may be this many times the wanted one. Chosen: its estimates are
/// within a factor of two of the error (`globular study accuracy`), and its steps are mostly those that just meet it.
constexpr double kToleratedError = 1.25;

/// "1 birth" or "12 births".
std::string counted(std::uint64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string strayWarning(std::uint64_t count) {
    return fmt::format(
        "{} and will be computed until the run ends; a [world] with bounds removes them",
        count == 1 ? "a particle has left the scene" : fmt::format("{} particles have left the scene", count));
}

void warnOfStrays(const engine::Simulation& simulation) {
    const std::uint64_t count = engine::strayCount(simulation);
    if (count > 0) printWarning(strayWarning(count));
}

bool isErrorMissed(double error, double wanted) {
    return error > kToleratedError * wanted;
}

std::vector<std::string> troublesOf(const scenes::Scene& scene, const engine::Simulation& simulation) {
    std::vector<std::string> troubles;
    if (const std::string missed = missedRates(scene, simulation); !missed.empty()) troubles.push_back(missed);
    const engine::AutoState& automatic = simulation.automatic;
    if (automatic.intervalCount > 0) {
        const double error = automatic.errorSum / static_cast<double>(automatic.intervalCount);
        const double wanted = simulation.setup.error;
        if (isErrorMissed(error, wanted))
            troubles.push_back(
                fmt::format("the error was {:.2g} radii a second on average, {:g} wanted", error, wanted));
    }
    if (const std::uint64_t held = simulation.steps.held; held > 0)
        troubles.push_back(
            fmt::format("{} held at the barrier of an obstacle", counted(held, "contact was", "contacts were")));
    if (const std::uint64_t outside = simulation.wallDepths.centersOutside; outside > 0)
        troubles.push_back(fmt::format(
            "up to {} at once", counted(outside, "particle was beyond a surface", "particles were beyond a surface")));
    return troubles;
}

std::string troubleLine(const scenes::Scene& scene, const engine::Simulation& simulation) {
    const std::vector<std::string> troubles = troublesOf(scene, simulation);
    return troubles.empty() ? "" : fmt::format("trouble: {}\n", fmt::join(troubles, "; "));
}

}  // namespace tools
