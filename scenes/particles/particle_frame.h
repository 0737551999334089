// What `globular simulate` knows of the particles of a frame when it writes them to a file, in whatever format.
#pragma once

#include <string>
#include <vector>

#include "engine/state/particles.h"

namespace scenes {

/// Which moment of which scene a state of particles is.
struct StateStamp {
    int frame = 0;
    double time = 0.0;           ///< s
    std::string simulationHash;  ///< Scene::simulationHash

    friend bool operator==(const StateStamp&, const StateStamp&) = default;
};

/// The particles of one frame, and what they belong to.
struct ParticleFrame {
    const engine::Particles& particles;
    StateStamp stamp;
    std::vector<std::string> materialNames;    ///< by the index that particles have
    std::vector<engine::Vec3> materialColors;  ///< linear RGB in [0,1], one for each name
    std::vector<double> temperature = {};      ///< of the particles, K; empty in scenes without heat
};

}  // namespace scenes
