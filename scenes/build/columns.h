// Columns: how tall bodies are and how closely they are packed, from which follows how far they sink under their own
// weight. Called by build_materials.cpp, which chooses b1 for a wanted compression, and by build_bodies.cpp for what
// `globular check` says of each body.
#pragma once

#include <optional>
#include <vector>

#include "engine/force_law/compression.h"
#include "scenes/build/builders.h"

namespace scenes {

/// Whether a [material] asks for a compression that b1 can be chosen for. Records a problem where depth is given
/// without compression or there is no gravity.
bool checkCompression(Section& material, BuildContext& context);

/// The column whose compression the keys of a [material] describe: as tall as they say, or as the tallest body of the
/// material, and packed like that body, or two radii apart if there is none. Nothing, with the problem recorded, if
/// neither tells the height.
std::optional<engine::Column> columnFor(Section& section, const engine::Material& material,
                                        const std::vector<Section>& bodies, BuildContext& context);

/// The column that a body is before it sinks; nothing for one of shape points or file and for one whose table has
/// problems.
/// @param material  gives the radius of the particles, unless the body does
std::optional<engine::Column> columnOf(const Section& body, const engine::Material& material,
                                       const BuildContext& context);

/// The column that particles are which are given one by one. It has no height if there is no more than one.
/// @param material  of the particles; it is assumed that they are as far apart as without pressure
engine::Column columnOf(std::span<const engine::Vec3> positions, const engine::Material& material,
                        const BuildContext& context);

}  // namespace scenes
