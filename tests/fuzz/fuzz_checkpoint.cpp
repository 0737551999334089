// Fuzzes the reader of checkpoints: any bytes are either rejected, or are a state that can be saved, restored and
// advanced. A valid checksum is appended to the bytes, because almost all inputs would otherwise fail there.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "engine/core/hash.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"

namespace {

engine::Setup setupOf(engine::StepperKind stepper) {
    engine::Setup setup;
    setup.materials = {*engine::materialPreset("powder")};
    engine::append(setup.initial, {.position = engine::Vec3(0.0, 1.0, 0.0), .mass = 0.1});
    engine::append(setup.initial, {.position = engine::Vec3(0.2, 1.2, 0.0), .mass = 0.1});
    engine::Emitter nozzle;
    nozzle.sites = {engine::Vec3(1.0, 1.0, 0.0)};
    nozzle.interval = 0.02;
    setup.emitters = {nozzle};
    setup.obstacles.shapes = {engine::Plane{}};
    setup.stepper = stepper;
    return setup;
}

/// Whether a scene could have led to the state. Particles at 100 m/s are valid, too, but need a step for every radius
/// of their way, which takes a fuzzer too long; and after a million years a step is smaller than the rounding of the
/// time.
bool isPlausible(const engine::Simulation& simulation) {
    const auto& velocities = simulation.particles.velocity;
    const auto& controls = simulation.automatic.controls;
    return simulation.time < 1e4 &&
           std::all_of(velocities.begin(), velocities.end(),
                       [](const engine::Vec3& velocity) { return engine::squaredLength(velocity) < 1e4; }) &&
           std::all_of(controls.begin(), controls.end(),
                       [](const engine::StepControl& steps) { return steps.step == 0.0 || steps.step > 1e-6; });
}

void tryToAdvance(engine::StepperKind stepper, const std::vector<std::uint8_t>& bytes) {
    const engine::Setup setup = setupOf(stepper);
    std::optional<engine::Simulation> simulation;
    try {
        simulation = engine::decodeCheckpoint(setup, bytes);
    } catch (const engine::CheckpointError&) {
        return;
    }
    engine::decodeCheckpoint(setup, engine::encodeCheckpoint(*simulation));
    if (!isPlausible(*simulation)) return;
    try {
        engine::advance(*simulation, simulation->time + 0.001);
    } catch (const engine::InstabilityError&) {
        return;
    }
    engine::decodeCheckpoint(setup, engine::encodeCheckpoint(*simulation));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint8_t> bytes(data, data + size);
    const std::uint64_t checksum = engine::fnv1aOf(bytes);
    bytes.resize(size + 8);
    std::memcpy(bytes.data() + size, &checksum, 8);
    tryToAdvance(engine::StepperKind::velocityVerlet, bytes);
    tryToAdvance(engine::StepperKind::automatic, bytes);
    return 0;
}
