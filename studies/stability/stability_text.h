// The judged cases as text: the table on the terminal, its rows for the page, and CSV for other programs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "studies/stability/stability.h"

namespace studies {

/// The columns of the table.
inline constexpr std::array kStabilityColumns = {"#",     "case",  "paper's stepper", "ours",  "observable",
                                                 "value", "limit", "judged",          "steps", "seconds"};

using StabilityRow = std::array<std::string, kStabilityColumns.size()>;

/// A case by its worst variant, of the paper's stepper and of ours each.
StabilityRow rowOf(const CaseResult& result);

/// "exploded at 0.12 s", "3.1: fails", "0.002: passes".
std::string outcomeText(const Outcome& outcome);

/// "0.03", "1.9 to 2.1".
std::string limitText(const scenes::Study& study);

/// The table with aligned columns, a line for each case.
std::string stabilityTable(const std::vector<CaseResult>& results);

/// What went wrong, a line each; empty where all is as it should be.
std::string stabilityProblems(const std::vector<CaseResult>& results);

/// Every variant of every case, with a header line.
std::string stabilityCsv(const std::vector<CaseResult>& results);

}  // namespace studies
