// The observables of the hard cases: one number for a run, which is compared with a limit. Called by stability.cpp.
#pragma once

#include "studies/stability/stability.h"

namespace studies {

/// What an observable is computed from.
struct ObservableInput {
    const scenes::Scene& scene;      ///< the scene, with the stepper and step of the run
    const Run& run;                  ///< the run, which reached the end of the scene
    const Run* reference = nullptr;  ///< the run at the reference step; null: none
};

/// The value of an observable for a run, in the unit that scenes::infoOf() names; infinite if the run and the reference
/// run cannot be compared.
/// @throws scenes::InputError if the observable makes no sense for the scene, or needs particles and none are left
/// @throws engine::InstabilityError if runs that the observable makes itself become unstable
double measure(scenes::Observable observable, const ObservableInput& input);

// There is a function for each observable. scenes/schema/study.cpp says what the observables mean, and the comments at
// the definitions of the functions how they are computed.

double pairLaw(const ObservableInput& input);
double momentumDrift(const ObservableInput& input);
double energyRise(const ObservableInput& input);
double positionError(const ObservableInput& input);
double heightError(const ObservableInput& input);
double frontError(const ObservableInput& input);
double radiusError(const ObservableInput& input);
double statisticsError(const ObservableInput& input);
double reboundError(const ObservableInput& input);
double restitutionError(const ObservableInput& input);
double largestSpeed(const ObservableInput& input);
double medianSpeed(const ObservableInput& input);
double fragments(const ObservableInput& input);
double spacing(const ObservableInput& input);
double tunnelingCount(const ObservableInput& input);
double penetration(const ObservableInput& input);
double refusals(const ObservableInput& input);
double stepBound(const ObservableInput& input);
double order(const ObservableInput& input);
double cost(const ObservableInput& input);

}  // namespace studies
