// Any bytes are a state that a simulation can go on from, or are refused. The checksum is put right first: it would
// keep everything else from being tried.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/checkpoint.h"
#include "engine/fnv.h"

namespace {

engine::Setup setup() {
    engine::Setup setup;
    setup.materials = {*engine::materialPreset("powder")};
    engine::append(setup.initial, {.position = engine::Vec3(0.0, 1.0, 0.0), .mass = 0.1});
    engine::append(setup.initial, {.position = engine::Vec3(0.2, 1.2, 0.0), .mass = 0.1});
    engine::Emitter nozzle;
    nozzle.sites = {engine::Vec3(1.0, 1.0, 0.0)};
    nozzle.interval = 0.02;
    setup.emitters = {nozzle};
    setup.scenery.colliders = {engine::Plane{}};
    setup.stepper = engine::StepperKind::velocityVerlet;
    return setup;
}

/// A state from the far future, or grains of the size of atoms or of the speed of light, would take as many steps as
/// that is out of proportion: audited steps are never longer than what keeps a grain from jumping over another.
bool isInProportion(const engine::Simulation& simulation) {
    const engine::Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (!(particles.radius[p] > 1e-3 && particles.mass[p] > 1e-3 && particles.velocity[p].norm() < 1e3))
            return false;
    return simulation.time < 10.0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint8_t> bytes(data, data + size);
    const std::uint64_t checksum = engine::fnv1aOf(bytes);
    bytes.resize(size + 8);
    std::memcpy(bytes.data() + size, &checksum, 8);
    try {
        engine::Simulation simulation = engine::decodeCheckpoint(setup(), bytes);
        if (isInProportion(simulation)) engine::advance(simulation, simulation.time + 0.01);
    } catch (const engine::CheckpointError&) {
    } catch (const engine::InstabilityError&) {
    }
    return 0;
}
