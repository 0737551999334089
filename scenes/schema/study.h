// A hard case of `globular study stability`, as its scene's [study] table describes it: which observable, how far it
// may go, and what is varied. studies/ measures it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/text/override.h"

namespace scenes {

/// What is measured of a run. studies/stability/observables.h says how; kObservables names each with its unit.
enum class Observable {
    pairLaw,
    momentumDrift,
    energyRise,
    positionError,
    heightError,
    frontError,
    radiusError,
    statisticsError,
    reboundError,
    restitutionError,
    largestSpeed,
    medianSpeed,
    fragments,
    spacing,
    passed,
    refusals,
    stepBound,
    order,
    cost
};

struct ObservableInfo {
    Observable observable = Observable::positionError;
    std::string_view name;        ///< in scene files
    std::string_view unit;        ///< of the value and its limits; empty: a plain number
    bool needsReference = false;  ///< is taken against the same scene at the reference step
    std::string_view help;        ///< one line
};

/// All of them in the order of the enumeration.
const std::vector<ObservableInfo>& observables();

const ObservableInfo& infoOf(Observable observable);

struct Study {
    int number = 1;  ///< place in the table
    Observable observable = Observable::positionError;
    double limit = 0.0;                   ///< passes up to this
    std::optional<double> atLeast;        ///< and from this on
    bool paperMustFail = false;           ///< the paper's stepper has to fail
    double paperStep = 0.01;              ///< s
    std::optional<double> referenceStep;  ///< s
    engine::StepperKind referenceStepper = engine::StepperKind::velocityVerlet;
    std::vector<std::string> vary;   ///< variants as KEY=VALUE;KEY=VALUE; none: the scene as it is
    std::vector<std::string> quick;  ///< those that --quick runs
};

/// "a=1; b=2" as overrides.
Overrides overridesOf(std::string_view variant);

/// The variants that a run of the study takes; one without changes where the study lists none.
std::vector<std::string> variantsOf(const Study& study, bool quick);

}  // namespace scenes
