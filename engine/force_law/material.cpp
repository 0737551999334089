// The material presets, and the symmetric mixture of two materials.
#include "engine/force_law/material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace engine {

/// Table 1, row by row, with the published masses of 1 kg; then the substances that the paper names without constants.
/// The substances were chosen by their appearance at g = 9.81 m/s^2: b_d over the mass sets the viscosity, b1 / (D0^4 m
/// g) how far a pile is compressed by its own weight (at 5 to 10 it levels like a liquid, at 20 it keeps the slope of a
/// crystal), and c_r the cohesion. c_r stays below 1.8, above which matter collapses under its own attraction. Columns:
/// name, radius, mass, b1, b_d, c_r, c_d and, where there is friction, mu.
std::span<const Material> materialPresets() {
    static const std::array<Material, 11> presets = {{
        {"liquid", 0.15, 1.0, 0.01, 1.0, 1.0, 2.0},
        {"solid", 0.15, 1.0, 0.8, 4.0, 2.0, 2.0},
        {"powder", 0.15, 1.0, 0.8, 4.0, 1.0, 1.0},
        {"fountain", 0.15, 1.0, 0.01, 1.0, 1.0, 2.0},
        {"honey", 0.08, 0.05, 0.003, 8.0, 1.1, 2.0},
        {"jam", 0.1, 0.1, 0.012, 25.0, 1.25, 1.5, 0.12},
        {"oil", 0.08, 0.05, 0.0015, 0.25, 1.1, 2.0},
        {"lava", 0.12, 0.3, 0.12, 20.0, 1.2, 1.5, 0.03},
        {"mud", 0.12, 0.2, 0.08, 15.0, 1.2, 1.5, 0.1},
        {"molten-metal", 0.06, 0.06, 0.0015, 0.1, 1.1, 1.5},
        {"sand", 0.08, 0.015, 0.03, 1.2, 1.0, 1.0, 0.3},
    }};
    return presets;
}

std::optional<Material> materialPreset(std::string_view name) {
    const std::span<const Material> presets = materialPresets();
    const auto preset = std::ranges::find(presets, name, &Material::name);
    return preset == presets.end() ? std::nullopt : std::optional(*preset);
}

Material withRadius(const Material& material, double radius) {
    const double ratio = radius / material.radius;
    const double volumeRatio = ratio * ratio * ratio;
    Material scaled = material;
    scaled.radius = radius;
    scaled.mass = material.mass * volumeRatio;
    scaled.repulsion = material.repulsion * volumeRatio * volumeRatio;
    scaled.damping = material.damping * ratio;
    return scaled;
}

Material mixed(const Material& a, const Material& b) {
    Material mix;
    mix.repulsion = std::sqrt(a.repulsion * b.repulsion);
    mix.damping = std::sqrt(a.damping * b.damping);
    mix.repulsionReach = 0.5 * (a.repulsionReach + b.repulsionReach);
    mix.dampingReach = 0.5 * (a.dampingReach + b.dampingReach);
    mix.friction = std::sqrt(a.friction * b.friction);
    mix.coreFraction = 0.5 * (a.coreFraction + b.coreFraction);
    mix.cohesion = std::sqrt(a.cohesion * b.cohesion);
    mix.pull = std::sqrt(a.pull * b.pull);
    mix.restRatio = 0.5 * (a.restRatio + b.restRatio);
    return mix;
}

}  // namespace engine
