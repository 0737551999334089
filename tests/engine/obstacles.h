// Sceneries of a single obstacle.
#pragma once

#include "engine/law/obstacles.h"

inline engine::Scenery only(const engine::Collider& collider) {
    engine::Scenery scenery;
    scenery.colliders = {collider};
    return scenery;
}
