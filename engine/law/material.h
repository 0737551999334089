// Materials: Table 1 of the paper and the substances it names as data, and how two different materials act on each
// other. Scenes start from a preset and override what they like; pair_law.h turns two materials into the constants of a
// pair.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

/// What a particle is made of; the constants of equations 2, 5 and 6 and the size of a particle.
struct Material {
    std::string name;
    double radius = 0.15;         ///< r, m
    double mass = 1.0;            ///< M, kg
    double repulsion = 0.01;      ///< b1, N m^4
    double damping = 1.0;         ///< b_d, kg/s
    double repulsionReach = 1.0;  ///< c_r, multiples of the rest length; above 1 particles attract
    double dampingReach = 2.0;    ///< c_d, multiples of the rest length
    double friction = 0.0;        ///< mu, tangential over normal force; 0: none, as in the paper
    double coreFraction = 0.25;  ///< the guard near D = 0: below this share of the rest length the force is linear in D
};

/// A row of Table 1 (liquid, solid, powder, fountain) or a substance that the paper names (honey, jam, oil, lava, mud,
/// molten-metal, sand); nothing for any other name.
std::optional<Material> materialPreset(std::string_view name);

/// The names of all presets: those of Table 1 in its order, then the substances.
const std::vector<std::string>& materialPresetNames();

/// The material that governs a pair of unlike particles. Symmetric in its arguments, so that a mixed pair keeps
/// momentum: geometric means of b1, b_d and mu, arithmetic means of the reaches and of the core. Radius and mass are
/// per particle and left out.
Material mixed(const Material& a, const Material& b);

}  // namespace engine
