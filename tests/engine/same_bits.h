// Compares the bits of a run with those of the same run on other instruction sets, resumed, and shared by ranks.
#pragma once

#include <string>

#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "engine/run/redistribution.h"
#include "tests/catch.h"
#include "tests/engine/on_instruction_set.h"
#include "tests/engine/runs.h"
#include "tests/engine/thread_ranks.h"

namespace same_bits {

/// Hash of the particles after some frames.
inline std::string hashAfter(engine::Simulation simulation, int from, int to) {
    runs::advanceFrames(simulation, from, to);
    return engine::stateHash(simulation.particles);
}

/// Checks that the set-up's particles, which are within a meter of the origin, end with the same bits on every
/// instruction set, when the run is resumed halfway, and on three ranks.
inline void checkEverywhere(const engine::Setup& setup, int frames) {
    const std::string expected = hashAfter(start(setup), 0, frames);
    for (const std::string& name : engine::instructionSets()) {
        const OnInstructionSet on(name);
        INFO(name);
        CHECK(hashAfter(start(setup), 0, frames) == expected);
    }
    engine::Simulation half = start(setup);
    runs::advanceFrames(half, 0, frames / 2);
    CHECK(hashAfter(decodeCheckpoint(setup, encodeCheckpoint(half)), frames / 2, frames) == expected);
    std::string onRanks;
    thread_ranks::onRanks(3, thread_ranks::slabs(3, 0.3), [&](const engine::Ranks& ranks) {
        engine::Simulation part = start(setup, ranks);
        runs::advanceFrames(part, 0, frames / 2);
        redistribute(part);
        runs::advanceFrames(part, frames / 2, frames);
        engine::Simulation whole = start(setup);
        gather(part, whole);
        if (ranks.own() == 0) onRanks = engine::stateHash(whole.particles);
    });
    CHECK(onRanks == expected);
}

}  // namespace same_bits
