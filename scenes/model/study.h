// The [study] table of a scene: which observable `globular study stability` measures, the limits that it has to stay
// within, and which keys of the scene are varied. studies/stability does the measuring.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/state/setup.h"
#include "scenes/text/override.h"

namespace scenes {

/// The quantities that a stability study can measure of a run. study.cpp describes each;
/// studies/stability/observables.h measures them.
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
    penetration,
    refusals,
    stepBound,
    order,
    cost
};

struct ObservableInfo {
    Observable observable = Observable::positionError;
    std::string_view name;        ///< as in scene files
    std::string_view unit;        ///< unit of the observable and its limits; empty: dimensionless; "r": particle radii
    bool needsReference = false;  ///< the run is compared with one of the same scene at the reference step
    std::string_view help;        ///< one line
};

/// All observables, each at the index that is its number in the enumeration.
const std::vector<ObservableInfo>& observables();

const ObservableInfo& infoOf(Observable observable);

struct Study {
    int number = 1;  ///< row in the study's table
    Observable observable = Observable::positionError;
    double limit = 0.0;                   ///< the largest value of the observable that passes
    std::optional<double> atLeast;        ///< the smallest value of the observable that passes
    bool paperMustFail = false;           ///< the study expects the paper's stepper to fail
    double paperStep = 0.01;              ///< time step of the paper's stepper, s
    std::optional<double> referenceStep;  ///< time step of the reference run, s
    engine::StepperKind referenceStepper = engine::StepperKind::velocityVerlet;
    std::vector<std::string> vary;   ///< variants of the scene, "KEY=VALUE; KEY=VALUE"; none: the scene as it is
    std::vector<std::string> quick;  ///< variants that the option --quick runs; none: all variants
};

/// The overrides that a variant of a scene consists of; the text "a=1; b=2" has two.
Overrides overridesOf(std::string_view variant);

/// The variants of the scene that a study runs; a single empty text, for the scene as it is, where the study lists
/// none.
std::vector<std::string> variantsOf(const Study& study, bool isQuick);

}  // namespace scenes
