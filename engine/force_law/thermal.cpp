// Piecewise linear functions of the enthalpy.
#include "engine/force_law/thermal.h"

#include <algorithm>

namespace engine {
namespace {

/// Specific heat between the first and the last melting, J/kg.
double heatOfMelting(const Thermal& thermal) {
    return thermal.latent + thermal.capacity * thermal.meltingRange;
}

/// Specific heat beyond the point where melting begins, J/kg; negative below.
double beyondMelting(const Thermal& thermal, double enthalpy) {
    return enthalpy - thermal.capacity * thermal.melting;
}

}  // namespace

double enthalpyAt(const Thermal& thermal, double temperature) {
    const double beyond = temperature - thermal.melting;
    if (beyond <= 0.0) return thermal.capacity * temperature;
    if (beyond >= thermal.meltingRange) return thermal.capacity * temperature + thermal.latent;
    return thermal.capacity * thermal.melting + heatOfMelting(thermal) * (beyond / thermal.meltingRange);
}

double temperatureAt(const Thermal& thermal, double enthalpy) {
    const double beyond = beyondMelting(thermal, enthalpy);
    if (!(beyond > 0.0)) return enthalpy / thermal.capacity;
    const double heat = heatOfMelting(thermal);
    if (beyond < heat) return thermal.melting + thermal.meltingRange * (beyond / heat);
    return thermal.melting + thermal.meltingRange + (beyond - heat) / thermal.capacity;
}

double meltedShare(const Thermal& thermal, double enthalpy) {
    const double beyond = beyondMelting(thermal, enthalpy);
    if (!(beyond > 0.0)) return 0.0;
    const double heat = heatOfMelting(thermal);
    return beyond < heat ? beyond / heat : 1.0;
}

double warming(const Thermal& thermal, double enthalpy) {
    const double beyond = beyondMelting(thermal, enthalpy);
    const double heat = heatOfMelting(thermal);
    if (beyond >= 0.0 && beyond < heat) return thermal.meltingRange / heat;
    return 1.0 / thermal.capacity;
}

}  // namespace engine
