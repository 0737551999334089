// How a material changes its constants while it melts: stages between a solid and a melted material, which are
// materials of their own, so that every kernel that serves mixtures serves melts.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/force_law/material.h"

namespace engine {

/// The stages of a melting material, by their indices in the list of materials: the solid one, and `count` more in a
/// row, the last of which is the melt.
struct Melt {
    std::uint32_t solid = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 1;
};

/// Most stages that follow a solid material, the melt among them. Chosen: b1 and b_d that differ by a factor of a
/// hundred change by a third from stage to stage.
inline constexpr std::uint32_t kMostStages = 16;

/// The stages that follow a solid material, the last of which has all constants of the melt. Strengths that differ by
/// factors, b1 and b_d, change geometrically unless one of them is 0, and all others linearly. Radius, mass and thermal
/// constants are those of the solid.
/// @param count  a power of two
std::vector<Material> stagesOf(const Material& solid, const Material& melt, std::uint32_t count);

/// The material of a particle of which this share has melted.
std::uint32_t stageAt(const Melt& melt, double share);

/// Whether a material, by its index, is a stage of a melting one.
bool isStage(const Melt& melt, std::uint32_t material);

}  // namespace engine
