// The page of `globular study stability`: the table, and every variant behind it, as one HTML file.
#pragma once

#include <string>
#include <vector>

#include "studies/stability/stability.h"

namespace tools {

/// The page as HTML. command: the line that makes it again.
std::string stabilityPage(const std::vector<studies::CaseResult>& results, const std::string& command);

}  // namespace tools
