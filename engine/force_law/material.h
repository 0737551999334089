// Materials as plain data: the rows of Table 1 of the paper, the substances that the paper names, and how two different
// materials act on each other. Scenes start from a preset and override single constants; pair_law.h computes the
// constants of a pair from a material.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/force_law/thermal.h"

namespace engine {

/// A material: the constants of equations 2, 5 and 6 of the paper, and the radius and mass of its particles.
struct Material {
    std::string name;
    double radius = 0.15;         ///< r, m
    double mass = 1.0;            ///< M, kg
    double repulsion = 0.01;      ///< strength b1 of the repulsion, N m^4
    double damping = 1.0;         ///< damping coefficient b_d, kg/s
    double repulsionReach = 1.0;  ///< reach c_r of the force, in rest lengths; particles attract above 1
    double dampingReach = 2.0;    ///< reach c_d of the damping, in rest lengths
    double friction = 0.0;        ///< friction coefficient mu; the paper has no friction
    double coreFraction = 0.25;   ///< core distance in rest lengths, below which the force is linear
    Thermal thermal = {};         ///< the paper has no heat
    double cohesion = 0.0;        ///< surface tension sigma, N/m; the paper has none. Set by withCohesion()
    double pull = 0.0;            ///< strength kappa of the pull that makes it, N/m
    double agitation = 0.0;       ///< energy of random motion over sigma D0^2; the paper has none. See heat/agitation.h
    double restRatio = 1.0;       ///< distance at which repulsion ends, in rest lengths; above 1 where there is a pull
};

/// All presets: the rows of Table 1 in its order (liquid, solid, powder, fountain), then the substances that the paper
/// names (honey, jam, oil, lava, mud, molten-metal, sand).
std::span<const Material> materialPresets();

/// The preset of this name; empty if there is none.
std::optional<Material> materialPreset(std::string_view name);

/// The material with particles of another radius (m). The mass grows with the third power of the radius, b1 with the
/// sixth and b_d with the first, which leaves density, stiffness and viscosity as they are: pressures are b1/D0^6 times
/// a function of how far the particles are compressed, and viscous stresses b_d/D0 times the rate of strain. The
/// surface tension stays the same as well, but the pull that makes it is stronger for finer particles: withCohesion()
/// is to be called afterwards.
Material withRadius(const Material& material, double radius);

/// The material by which two particles of different materials interact: geometric means of b1, b_d, mu and the pull,
/// arithmetic means of the reaches, of the core and of the rest ratio. The result is the same for either order of the
/// arguments, so that a pair conserves momentum. Its radius and mass have no meaning.
Material mixed(const Material& a, const Material& b);

}  // namespace engine
