// Strays: particles and sphere obstacles that have left the picture, because they fell off an edge, for example, or
// were shot away. They are removed before anything else is made of a view. Otherwise the light's depth map and the grid
// of the sky visibility, which have a limited number of cells, would have to cover the way to them and would be coarse
// where the picture is. Called by the renderer.
//
// A smooth skin searches for neighbors in a grid of a limited number of cells, too. Meshes have the skin of all
// particles, whatever the picture shows of them; groups with wide gaps between them then have a grid each.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"

namespace render {

/// The view without its strays, or nothing if it has none.
///
/// A stray is a particle that does not touch the picture, nor lies so near that it may hide some of the sky from what
/// is seen, nor casts a shadow on anything that is seen; and that lies outside of the box around the particles that are
/// seen, grown by half of its longest side on each side. What is nearer does no harm, and a film in which particles
/// leave the picture shall not change with each of them. The same holds for sphere obstacles. A view in which no
/// particle is seen has no strays.
///
/// The shadow of a ball does not count at a distance of more than 2048 of its radii, or where it is narrower than half
/// a pixel. The radius of a metaball is that of its field.
std::optional<View> withoutStrays(const View& view, const CameraFrame& frame);

/// Cuts a set of particles at every gap along an axis, and the parts again, until the box around a part is small or has
/// no gap along any axis. Particles of different parts are thus further apart than the width of a gap.
/// @param gap  least width of a gap, m, > 0
/// @param mostCells  a box of no more than so many cubes with sides of `gap` is small
/// @return the increasing indices of each part's particles; nothing if all are one part
std::vector<std::vector<std::uint32_t>> separateGroups(std::span<const Sphere> particles, float gap, double mostCells);

}  // namespace render
