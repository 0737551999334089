// The benchmark of whole frames: runs a scene past its still, and times simulating and drawing each frame. See bench.h.
#include "studies/bench/bench.h"

#include <optional>

#include "engine/run/diagnostics.h"
#include "render/renderer.h"
#include "scenes/view/frame_view.h"
#include "studies/common/fcc_cube.h"
#include "studies/common/timing.h"

namespace studies {

std::vector<BenchRow> benchFrames(const std::string& name, const scenes::Scene& scene, render::Context* context,
                                  int rounds) {
    engine::Simulation simulation = engine::start(scene.setup);
    int frame = scenes::stillFrame(scene);
    scenes::advanceToFrame(scene, simulation, frame);
    std::optional<render::Renderer> renderer;
    if (context != nullptr) {
        renderer.emplace(*context, scene.size, render::Quality::normal);
        renderer->draw(scenes::frameView(scene, simulation));  // drawing the first frame allocates memory
    }
    const std::uint64_t stepsBefore = simulation.steps.count;
    std::vector<double> simulated;
    std::vector<double> drawn;
    for (int round = 0; round < rounds; ++round) {
        ++frame;
        simulated.push_back(secondsOf([&] { scenes::advanceToFrame(scene, simulation, frame); }));
        if (!renderer) continue;
        const render::View view = scenes::frameView(scene, simulation);
        drawn.push_back(secondsOf([&] { renderer->draw(view); }));
    }
    BenchRow row;
    row.name = kSimulateFrame;
    row.material = name;
    row.particles = simulation.particles.count();
    row.neighbors = meanNeighbors(scene.setup, simulation.particles);
    row.precision = scene.setup.precision;
    row.seconds = median(simulated);
    row.steps = static_cast<double>(simulation.steps.count - stepsBefore) / rounds;
    row.stateHash = engine::stateHash(simulation.particles);
    if (!renderer) return {row};
    BenchRow drawing = row;
    drawing.name = kDrawFrame;
    drawing.neighbors = 0.0;
    drawing.steps = 1.0;
    drawing.seconds = median(drawn);
    return {row, drawing};
}

}  // namespace studies
