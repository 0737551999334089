// What a material does with heat: how warm a given heat makes it, and when it melts. The enthalpy method (Voller and
// Cross 1981): the state of a particle is its heat, and temperature and melted share follow from it, so that nothing
// has to find the front between solid and melt.
#pragma once

#include <limits>

namespace engine {

/// Distance within which particles conduct heat, in rest lengths. Chosen: the closest neighbors count five times as
/// much as the next.
inline constexpr double kConductingReach = 1.5;

/// Thermal constants of a material. The heat capacity is the same below and above the melting point.
struct Thermal {
    double capacity = 0.0;      ///< specific heat capacity c, J/(kg K); 0 for a material without heat
    double conductivity = 0.0;  ///< k, W/(m K)
    double melting = std::numeric_limits<double>::infinity();  ///< temperature Tm at which melting begins, K
    double meltingRange =
        0.0;              ///< by how much more a melt is warm when all of it has melted, K; 0 for a pure substance
    double latent = 0.0;  ///< heat of fusion L, J/kg

    bool exists() const { return capacity > 0.0; }
    bool operator==(const Thermal&) const = default;
};

/// Specific enthalpy h (J/kg), which is 0 at 0 K:
///   h = c T below Tm,  c Tm + (c + L/range) (T - Tm) while melting,  c T + L above.
/// Without a range, a material at Tm is solid.
double enthalpyAt(const Thermal& thermal, double temperature);

/// The temperature (K) that has a specific enthalpy (J/kg); the inverse of enthalpyAt().
double temperatureAt(const Thermal& thermal, double enthalpy);

/// The share that has melted at a specific enthalpy (J/kg), from 0 to 1.
double meltedShare(const Thermal& thermal, double enthalpy);

/// Rise of the temperature with the specific enthalpy, dT/dh, in K kg/J; 0 while a pure substance melts.
double warming(const Thermal& thermal, double enthalpy);

}  // namespace engine
