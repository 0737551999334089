// Materials as data: Table 1 of the paper, the substances that it names, and how two different materials act on each
// other. Scenes start from a preset and override single constants; pair_law.h turns a material into the constants of a
// pair.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace engine {

/// The constants of equations 2, 5 and 6, and the size of a particle.
struct Material {
    std::string name;
    double radius = 0.15;         ///< r, m
    double mass = 1.0;            ///< M, kg
    double repulsion = 0.01;      ///< b1, N m^4
    double damping = 1.0;         ///< b_d, kg/s
    double repulsionReach = 1.0;  ///< c_r, in rest lengths; above 1 particles attract
    double dampingReach = 2.0;    ///< c_d, in rest lengths
    double friction = 0.0;        ///< mu, tangential over normal force; the paper has none
    double coreFraction = 0.25;   ///< core distance in rest lengths: below it the force is linear in D
};

/// All presets: the rows of Table 1 in its order (liquid, solid, powder, fountain), then the substances that the paper
/// names (honey, jam, oil, lava, mud, molten-metal, sand).
std::span<const Material> materialPresets();

/// The preset of this name; empty if there is none.
std::optional<Material> materialPreset(std::string_view name);

/// The material of a pair of unlike particles: geometric means of b1, b_d and mu, arithmetic means of the reaches and
/// of the core. It is the same for either order of the arguments, so that the pair conserves momentum. Radius and mass
/// belong to the particles and keep their defaults.
Material mixed(const Material& a, const Material& b);

}  // namespace engine
