// The [study] table of a scene: which observable `globular study stability` measures, the limits that it has to stay
// within, and what is varied. studies/stability measures it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/state/setup.h"
#include "scenes/text/override.h"

namespace scenes {

/// What is measured of a run. studies/stability/observables.h says how.
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
    std::string_view name;        ///< as in scene files
    std::string_view unit;        ///< of the value and its limits; empty: dimensionless; "r": particle radii
    bool needsReference = false;  ///< it is compared with a run of the same scene at the reference step
    std::string_view help;        ///< one line
};

/// All observables in the order of the enumeration.
const std::vector<ObservableInfo>& observables();

const ObservableInfo& infoOf(Observable observable);

struct Study {
    int number = 1;  ///< row in the study's table
    Observable observable = Observable::positionError;
    double limit = 0.0;                   ///< the largest value that passes
    std::optional<double> atLeast;        ///< the smallest value that passes
    bool paperMustFail = false;           ///< the paper's stepper is expected to fail
    double paperStep = 0.01;              ///< time step of the paper's stepper, s
    std::optional<double> referenceStep;  ///< time step of the reference run, s
    engine::StepperKind referenceStepper = engine::StepperKind::velocityVerlet;
    std::vector<std::string> vary;   ///< variants as KEY=VALUE; KEY=VALUE; none: the scene as it is
    std::vector<std::string> quick;  ///< the variants that --quick runs
};

/// The overrides of a variant such as "a=1; b=2".
Overrides overridesOf(std::string_view variant);

/// The variants that a run of the study goes through; a single empty one where the study lists none.
std::vector<std::string> variantsOf(const Study& study, bool isQuick);

}  // namespace scenes
