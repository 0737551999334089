// What a scene says about heat, as plain data. The particles' heat is Particles::enthalpy, and what their materials do
// with it is in force_law/thermal.h.
#pragma once

#include <optional>
#include <vector>

#include "engine/force_law/material.h"
#include "engine/force_law/melting.h"

namespace engine {

/// The temperature of a room, where a scene says nothing else, K.
inline constexpr double kRoomTemperature = 293.15;

/// The air around the particles, which takes and gives heat where their surface is free, and does not change itself.
struct Air {
    double temperature = kRoomTemperature;  ///< K
    double exchange = 0.0;                  ///< heat transfer coefficient, W/(m^2 K)
    double emissivity = 0.0;                ///< share of a black body's radiation that particles give and take, 0 to 1
};

/// The heat of a run. It is exchanged at moments of its own, multiples of an interval, where a step must end.
struct HeatSetup {
    double interval = 1.0 / 30.0;  ///< time between two exchanges, s
    Air air;
    /// Temperatures (K) of the obstacles, in their order; those without one neither take nor give heat. May be shorter
    /// than the list of obstacles.
    std::vector<std::optional<double>> obstacles;
    std::vector<Melt> melts;  ///< of the materials that melt
};

/// The melt that a material, by its index, is a stage of; null if it does not melt.
inline const Melt* meltOf(const HeatSetup& heat, std::uint32_t material) {
    for (const Melt& melt : heat.melts)
        if (isStage(melt, material)) return &melt;
    return nullptr;
}

/// The material of a particle of which this is the material now, at a specific enthalpy (J/kg).
inline std::uint32_t stageAt(const HeatSetup& heat, const std::vector<Material>& materials, std::uint32_t material,
                             double enthalpy) {
    const Melt* const melt = meltOf(heat, material);
    return melt == nullptr ? material : stageAt(*melt, meltedShare(materials[melt->solid].thermal, enthalpy));
}

}  // namespace engine
