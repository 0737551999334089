// Compares the rate that an emitter is asked for with what fits.
#include "scenes/warnings/emission_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/run/fitting_rate.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

/// A rate is kept if this share of the particles find room. Chosen: less is seen.
constexpr double kKeptShare = 0.95;

}  // namespace

std::vector<std::string> emissionWarnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (std::size_t e = 0; e < scene.setup.emitters.size(); ++e) {
        if (!scene.tables.hasRate[e]) continue;
        const double share = engine::fittingShare(scene.setup, e);
        if (share >= kKeptShare) continue;
        const engine::Emitter& emitter = scene.setup.emitters[e];
        const double rate =
            static_cast<double>(engine::initialState(emitter).schedules.size() * emitter.cluster.size()) /
            emitter.interval;
        const double distance = 2.0 * emitter.clearance * scene.setup.materials[emitter.material].radius;
        const SourcePosition& table = scene.tables.emitters[e];
        const std::string message = fmt::format(
            "emitter {}: asked {:.3g}/s, about {:.3g}/s fit: {} {} of emission at {:.3g} m/s, and {:.3g} m from one "
            "particle to the next; leave rate and interval out, raise velocity, or lower clearance",
            e + 1, rate, share * rate, emitter.sites.size(), emitter.sites.size() == 1 ? "point" : "points",
            std::sqrt(engine::squaredLength(emitter.velocity)), distance);
        warnings.push_back(formatProblem({scene.sourceName, table.line, table.column, message}));
    }
    return warnings;
}

}  // namespace scenes
