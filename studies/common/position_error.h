// How far apart two states of one scene are, particle by particle.
#pragma once

#include <cstddef>

#include "engine/state/particles.h"

namespace studies {

struct PositionError {
    double rms = 0.0;          ///< radii
    double largest = 0.0;      ///< radii
    std::size_t compared = 0;  ///< particles
};

/// Whether two runs have the same particles, born at the same times.
bool sameBirths(const engine::Particles& a, const engine::Particles& b);

/// Distances between particles of the same id, each in its own radius.
/// Shape:  `common` particles were there when the two runs parted. Births since then are compared only if both runs
///         have the same ones at the same times: one birth that differs gives the later ids to other particles.
/// Returns: infinite errors where particles differ and there is none to compare.
PositionError positionError(const engine::Particles& particles, const engine::Particles& reference, std::size_t common);

/// The same particles, each moved by up to so many radii along every axis, at random but the same every time.
engine::Particles displaced(engine::Particles particles, double radii);

}  // namespace studies
