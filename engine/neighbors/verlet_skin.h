// How much more than the cutoff a neighbor list reaches. A entries32 skin serves for many steps, a entries16 one makes
// short rows; which is cheaper depends on how fast the particles are and how many neighbors they have.
#pragma once

namespace engine {

/// Width of the skin in cutoffs where nothing is known of the motion. Chosen: right for a liquid.
inline constexpr double kDefaultSkin = 0.1;

/// The width, in cutoffs, at which lists and passes together cost least a step.
/// Shape:  neighbors of a particle within the cutoff; way of the fastest one in a step, in cutoffs.
double optimalSkin(double neighbors, double way);

}  // namespace engine
