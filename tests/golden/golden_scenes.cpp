// Scenes with overrides are those whose first error estimates by the automatic stepper take longer than the whole suite
// may. A fixed step or a coarser error shows the same things.
#include "tests/golden/golden_scenes.h"

#include <fmt/format.h>

namespace golden {

std::string goldenName(const GoldenScene& scene, const std::string& style, int frame, const std::string& renderer) {
    return fmt::format("{}/{}{}/frame-{:05}.png", scene.name, style, renderer == "cpu" ? "" : "-" + renderer, frame);
}

const std::vector<GoldenScene>& scenes() {
    static const std::vector<GoldenScene> kScenes = {
        {"candle", 30, 75, {}},
        {"cascade", 30, 130, {}},
        {"casting", 20, 60, {}},
        {"chocolate", 15, 45, {}},
        {"conveyor", 20, 60, {}},
        {"drops", 15, 30, {}},
        {"fountain", 20, 60, {}, true},
        {"gate", 25, 50, {"physics.stepper=velocity-verlet", "physics.step=0.003"}},
        {"honey", 30, 90, {}},
        {"hourglass", 15, 45, {}},
        {"jam", 5, 30, {"physics.stepper=linearly-implicit", "physics.step=0.01"}},
        {"lava", 30, 90, {}},
        {"liquid", 5, 30, {"physics.stepper=velocity-verlet", "physics.step=0.004"}, true},
        {"mercury", 15, 45, {}},
        {"mixer", 25, 60, {"physics.error=2"}},
        {"molten-metal", 30, 90, {}},
        {"mud", 6, 24, {"physics.error=2"}},
        {"oil", 10, 30, {}},
        {"paper/attraction-1", 25, 400, {}},
        {"paper/attraction-2", 25, 400, {}},
        {"paper/attraction-3", 25, 400, {}},
        {"paper/figure-1", 100, 300, {}, true},
        {"paper/figure-2", 150, 375, {}, true},
        {"paper/figure-3", 400, 1400, {}, true},
        {"paper/figure-4", 100, 300, {}, true},
        {"paper/issue-high-b1", 800, 2500, {}},
        {"paper/issue-high-bd", 400, 1400, {}},
        {"paper/liquid-thick", 400, 1100, {}},
        {"paper/liquid-thin", 400, 1100, {}},
        {"paper/repulsion-1", 5, 100, {}},
        {"paper/repulsion-2", 5, 100, {}},
        {"paper/repulsion-3", 5, 100, {}},
        {"powder", 30, 100, {}, true},
        {"sand", 30, 100, {}},
        {"solid", 6, 24, {"physics.stepper=velocity-verlet", "physics.step=0.004"}, true},
        {"splash", 12, 40, {}},
        {"stamp", 25, 50, {"physics.error=2"}},
        {"sticky", 6, 20, {}},
        {"wine", 20, 45, {}, true},
        {"word", 15, 24, {}},
    };
    return kScenes;
}

}  // namespace golden
