// The observables of the hard cases: one number for a run, which the case's limit is held against.
#pragma once

#include "scenes/model/scene.h"
#include "studies/common/run.h"

namespace studies {

/// What an observable may look at.
struct ObservableInput {
    const scenes::Scene& scene;      ///< as it was run: with its stepper and step
    const Run& run;                  ///< to the end
    const Run* reference = nullptr;  ///< to the end; for the observables that need one
};

/// The value of an observable, in the unit of scenes::infoOf. Infinite where the two runs do not compare.
/// Throws: engine::InstabilityError, where the observable takes runs of its own.
double measure(scenes::Observable observable, const ObservableInput& trial);

// The observables one by one. What each means is said in scenes/schema/study.cpp, its derivation above its function.

double pairLaw(const ObservableInput& trial);
double momentumDrift(const ObservableInput& trial);
double energyRise(const ObservableInput& trial);
double positionError(const ObservableInput& trial);
double heightError(const ObservableInput& trial);
double frontError(const ObservableInput& trial);
double radiusError(const ObservableInput& trial);
double statisticsError(const ObservableInput& trial);
double reboundError(const ObservableInput& trial);
double restitutionError(const ObservableInput& trial);
double largestSpeed(const ObservableInput& trial);
double medianSpeed(const ObservableInput& trial);
double fragments(const ObservableInput& trial);
double spacing(const ObservableInput& trial);
double tunnelingCount(const ObservableInput& trial);
double refusals(const ObservableInput& trial);
double stepBound(const ObservableInput& trial);
double order(const ObservableInput& trial);
double cost(const ObservableInput& trial);

}  // namespace studies
