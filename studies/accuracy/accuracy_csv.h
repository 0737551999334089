// The tables of the accuracy study as CSV text: numbers in the units their column names say, empty where there is none.
#pragma once

#include <string>
#include <vector>

#include "studies/accuracy/accuracy.h"

namespace studies {

/// One line for each run.
std::string accuracyCsv(const std::vector<SceneAccuracy>& scenes);

/// One line for each fixed stepper of each scene.
std::string ordersCsv(const std::vector<SceneAccuracy>& scenes);

/// One line for each wanted error of each scene.
std::string autosCsv(const std::vector<SceneAccuracy>& scenes);

/// One line for each scene.
std::string referencesCsv(const std::vector<SceneAccuracy>& scenes);

}  // namespace studies
