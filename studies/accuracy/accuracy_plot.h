// Work-precision plots as gnuplot scripts: error against cost on logarithmic axes, a line of points for each stepper.
#pragma once

#include <string>

#include "studies/accuracy/accuracy.h"

namespace studies {

enum class CostAxis {
    seconds,          ///< wall clock
    forceEvaluations  ///< over all pairs: force evaluations, and products of the implicit steppers' matrix at their
                      ///< share
};

/// A script that makes gnuplot write an SVG to its standard output.
/// Holds:  resolved runs alone are drawn; the key says how many of a stepper did not finish.
std::string plotScript(const SceneAccuracy& scene, CostAxis axis);

}  // namespace studies
