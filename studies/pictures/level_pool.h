// A level pool, whose volume is known: what smoothing and meshes do to volumes is measured on it.
#pragma once

#include "render/picture/view.h"

namespace studies {

/// A level pool on a jittered lattice with a spacing of 1 m, seen from above: its volume in m^3 is the number of its
/// particles. The paper's liquid settles at a spacing of 0.76 diameters, which gives the radius of 0.658.
/// @param appearance  what all but the particles, the ground and the camera are taken from
render::View levelPool(const render::View& appearance);

}  // namespace studies
