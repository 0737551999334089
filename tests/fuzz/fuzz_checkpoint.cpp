// Any bytes are a state that can be written, read again and gone on from, or are refused. The checksum is put right
// first: it would keep everything else from being tried.
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

/// Motion and steps that a scene could have led to. Grains faster than sound are no mistake, but take as many steps as
/// they are radii on their way, and after a million years a step is less than the clock tells apart.
bool isPlausible(const engine::Simulation& simulation) {
    const auto& velocities = simulation.particles.velocity;
    const auto& choices = simulation.automatic.choices;
    return simulation.time < 1e4 &&
           std::all_of(velocities.begin(), velocities.end(),
                       [](const engine::Vec3& velocity) { return engine::squaredLength(velocity) < 1e4; }) &&
           std::all_of(choices.begin(), choices.end(),
                       [](const engine::AutoChoice& choice) { return choice.step == 0.0 || choice.step > 1e-6; });
}

void tryGoingOn(engine::StepperKind stepper, const std::vector<std::uint8_t>& bytes) {
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
    tryGoingOn(engine::StepperKind::velocityVerlet, bytes);
    tryGoingOn(engine::StepperKind::automatic, bytes);
    return 0;
}
