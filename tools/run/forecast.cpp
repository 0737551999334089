// Counts the births on the emitters' schedules and runs the first frames.
#include "tools/run/forecast.h"

#include <algorithm>
#include <chrono>

#include "engine/run/run_memory.h"
#include "render/picture/view.h"
#include "scenes/view/frame_view.h"

namespace tools {
namespace {

void recordMemory(Preview& preview) {
    constexpr std::size_t kFramesInFlight = 4;  // number of frames in the pipeline of the render loop
    const std::size_t count = preview.simulation.particles.count();
    if (count == 0 || count < preview.mostParticles) return;
    preview.mostParticles = count;
    preview.bytesPerParticle = engine::peakBytes(preview.simulation) / count + kFramesInFlight * sizeof(render::Sphere);
}

}  // namespace

std::uint64_t plannedBirths(const scenes::Scene& scene) {
    const double lastFrame = scenes::frameTime(scene, scenes::frameCount(scene) - 1);
    std::uint64_t sum = 0;
    for (const engine::Emitter& emitter : scene.setup.emitters) sum += engine::askedCount(emitter, lastFrame);
    return sum;
}

engine::Particles everyKind(const scenes::Scene& scene) {
    engine::Particles particles = scene.setup.initial;
    for (const engine::Emitter& emitter : scene.setup.emitters) {
        const engine::Material& material = scene.setup.materials[emitter.material];
        engine::append(particles, {.radius = material.radius, .mass = material.mass, .material = emitter.material});
    }
    return particles;
}

Preview simulateBeginning(const scenes::Scene& scene, double mostSeconds) {
    constexpr double kSecondsEnough = 2.0;  // time for the first frames, s; chosen: as long as one waits for a check
    Preview preview;
    engine::Simulation& simulation = preview.simulation;
    const auto start = std::chrono::steady_clock::now();
    const auto secondsSoFar = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const auto recordFrame = [&] {
        preview.seconds = secondsSoFar();
        preview.particleFrames += static_cast<double>(simulation.particles.count());
        recordMemory(preview);
    };
    try {
        simulation = engine::start(scene.setup);
        preview.stepper = simulation.stepper;
        preview.bytesOfMaterials = engine::peakBytesOfMaterials(simulation);
        recordMemory(preview);
        simulation.beforeStep = [&](const engine::Simulation&) {
            if (secondsSoFar() > mostSeconds) throw engine::Stopped();
            ++preview.stepsInCutOff;
        };
        while (preview.frames + 1 < scenes::frameCount(scene) && preview.seconds < kSecondsEnough) {
            preview.stepsInCutOff = 0;
            scenes::advanceToFrame(scene, simulation, preview.frames + 1);
            ++preview.frames;
            preview.stepper = simulation.stepper;
            preview.steps = simulation.steps;
            preview.automatic = simulation.automatic;
            recordFrame();
        }
    } catch (const engine::Stopped&) {
        preview.isCutOff = true;
        recordFrame();
    } catch (const engine::InstabilityError& error) {
        preview.unstable = error.what();
    }
    simulation.beforeStep = nullptr;  // it refers to this function's variables
    return preview;
}

}  // namespace tools
