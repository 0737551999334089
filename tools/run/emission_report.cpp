// Counts what emitters were asked for.
#include "tools/run/emission_report.h"

#include <fmt/format.h>

namespace tools {

Json emittersJson(const engine::Simulation& simulation) {
    Json json = Json::array();
    for (std::size_t e = 0; e < simulation.emitters.size(); ++e) {
        const std::uint64_t asked = engine::askedCount(simulation.setup.emitters[e], simulation.time);
        const std::uint64_t born = simulation.emitters[e].births;
        json.push_back({{"asked", asked}, {"born", born}, {"refused", asked - born}});
    }
    return json;
}

std::string missedRates(const scenes::Scene& scene, const engine::Simulation& simulation) {
    constexpr double kKeptShare = 0.95;  // chosen: less is seen
    std::string text;
    int others = -1;
    for (std::size_t e = 0; e < simulation.emitters.size(); ++e) {
        const engine::Emitter& emitter = simulation.setup.emitters[e];
        const auto asked = static_cast<double>(engine::askedCount(emitter, simulation.time));
        const auto born = static_cast<double>(simulation.emitters[e].births);
        if (!scene.tables.hasRate[e] || born >= kKeptShare * asked) continue;
        if (++others > 0) continue;
        const auto perInterval = static_cast<double>(simulation.emitters[e].schedules.size() * emitter.cluster.size());
        const double rate = perInterval / emitter.interval;
        text = fmt::format("emitter {}: asked {:.3g}/s, {:.3g}/s fit", e + 1, rate, rate * born / asked);
    }
    if (others > 0) text += fmt::format(" ({} more missed theirs)", others);
    return text;
}

}  // namespace tools
