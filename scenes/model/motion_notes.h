// What moves in a scene, in words and numbers, for globular check.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace scenes {

/// How an obstacle or an emitter moves.
struct MotionNote {
    std::string what;        ///< "obstacle" or "emitter"
    std::size_t number = 0;  ///< its number among those of its kind, from 1
    std::string shape;       ///< of an obstacle, as the scene file names it; empty for an emitter
    std::string text;        ///< "moves at 1.2 m/s along +y until 2 s, then is taken away"
    /// The largest speed of the corners of the box around an obstacle or of an emitter's nozzle while it is there,
    /// found to some thousandths, m/s; nothing for what has no end and turns.
    std::optional<double> fastest;
    /// How far that takes an obstacle's surface from frame to frame, in radii of the smallest particles; nothing where
    /// the speed is not known and for emitters.
    std::optional<double> radiiPerFrame;
};

/// The notes on everything that moves or is taken away, obstacles first; what is at rest has none.
std::vector<MotionNote> motionNotes(const Scene& scene);

}  // namespace scenes
