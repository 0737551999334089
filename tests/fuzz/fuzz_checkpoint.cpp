// Any bytes are a state that can be written and read again, or are refused. The checksum is put right first: it would
// keep everything else from being tried.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint8_t> bytes(data, data + size);
    const std::uint64_t checksum = engine::fnv1aOf(bytes);
    bytes.resize(size + 8);
    std::memcpy(bytes.data() + size, &checksum, 8);
    std::optional<engine::Simulation> simulation;
    try {
        simulation = engine::decodeCheckpoint(setup(), bytes);
    } catch (const engine::CheckpointError&) {
        return 0;
    }
    // Not stepped: grains as small as atoms or as fast as light would take as many steps as that is out of proportion.
    engine::decodeCheckpoint(setup(), engine::encodeCheckpoint(*simulation));
    return 0;
}
