// The particles of one emission. Every random number is a function of seed, emitter, schedule and emission, so that the
// state of an emitter is a few counters, and a resumed run draws the same numbers as an uninterrupted one.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/particles.h"
#include "engine/state/setup.h"

namespace engine {

/// The index of an emitter in the setup, of one of its schedules, and of an emission of that schedule.
struct Emission {
    std::uint64_t emitter = 0;
    std::uint64_t schedule = 0;
    std::uint64_t number = 0;
    std::uint64_t attempt = 0;  ///< where sites are picked at random, which of several draws of the site
};

/// The particles of an emission at a time (s), which was due `late` seconds before. Since then they have flown freely
/// under gravity.
/// @param particles  receives the particles; what it held before is lost
void drawEmission(const Setup& setup, const Emission& emission, double time, double late,
                  std::vector<NewParticle>& particles);

}  // namespace engine
