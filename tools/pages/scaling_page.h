// The page of the study of scaling: the plot, the tables, and how to have them again, in one HTML file.
#pragma once

#include <string>
#include <vector>

#include "studies/scaling/lammps.h"
#include "studies/scaling/scaling.h"

namespace tools {

/// All that the study found.
struct ScalingResults {
    std::vector<studies::ScalingRow> rows;
    std::vector<studies::ScalingFit> fits;
    std::vector<studies::PeerRow> peers;  ///< empty where none was asked for
    std::string peerText;                 ///< of the peer, or why there is none
};

/// The page as HTML, the plot embedded.
std::string scalingPage(const ScalingResults& results, const std::string& plot, const std::string& command);

}  // namespace tools
