// What rate of emission fits. Found by letting an emitter emit into empty space, where its particles fly freely and
// only they are in the way of those that follow. Called by scenes/ for emitters without a rate and for warnings.
#pragma once

#include <cstddef>

#include "engine/state/setup.h"

namespace engine {

/// Share of the particles that an emitter (by its index) is asked for which find room, from 0 to 1. Obstacles and
/// forces between the particles are left out. Takes time in proportion to the particles of about a dozen emissions of
/// every site, and at most a few seconds.
double fittingShare(const Setup& setup, std::size_t emitter);

}  // namespace engine
