// Sets of obstacles with a single one.
#pragma once

#include "engine/force_law/obstacles.h"

inline engine::Obstacles only(const engine::Obstacle& obstacle) {
    engine::Obstacles obstacles;
    obstacles.shapes = {obstacle};
    return obstacles;
}
