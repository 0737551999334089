// The observables of the hard cases: one number for a run, which the case's limit is held against.
#pragma once

#include "scenes/model/scene.h"
#include "studies/common/run.h"

namespace studies {

/// What an observable may look at.
struct Trial {
    const scenes::Scene& scene;      ///< as it was run: with its stepper and step
    const Run& run;                  ///< to the end
    const Run* reference = nullptr;  ///< to the end; for the observables that need one
};

/// The value of an observable, in the unit of scenes::infoOf. Infinite where the two runs do not compare.
/// Throws: engine::InstabilityError, where the observable takes runs of its own.
double measure(scenes::Observable observable, const Trial& trial);

// The observables one by one. What each means is said in scenes/schema/study.cpp, its derivation above its function.

double pairLaw(const Trial& trial);
double momentumDrift(const Trial& trial);
double energyRise(const Trial& trial);
double positionError(const Trial& trial);
double heightError(const Trial& trial);
double frontError(const Trial& trial);
double radiusError(const Trial& trial);
double statisticsError(const Trial& trial);
double reboundError(const Trial& trial);
double restitutionError(const Trial& trial);
double largestSpeed(const Trial& trial);
double medianSpeed(const Trial& trial);
double fragments(const Trial& trial);
double spacing(const Trial& trial);
double passed(const Trial& trial);
double refusals(const Trial& trial);
double stepBound(const Trial& trial);
double order(const Trial& trial);
double cost(const Trial& trial);

}  // namespace studies
