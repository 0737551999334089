// A model of the time that a step takes on several ranks: what docs/beyond-one-machine.md fits to measurements and
// carries on to more ranks, and what `globular check --ranks` predicts.
#pragma once

namespace studies {

/// What a step works on, and how long it takes in one process.
struct StepOnOneRank {
    double particles = 0.0;
    double neighbors = 0.0;  ///< mean number within the cutoff
    double seconds = 0.0;    ///< on one thread
};

/// A step on several ranks of one thread each.
struct StepOnRanks {
    double particles = 0.0;   ///< of a rank
    double ghosts = 0.0;      ///< of a rank
    double seconds = 0.0;     ///< of all ranks together
    double efficiency = 0.0;  ///< time in one process over the time of all ranks added up; at most about 1
};

/// Time of one message or one stage of a collective operation between two machines, s. Chosen: of usual networks for
/// computing.
inline constexpr double kLatency = 3e-6;

/// What the model predicts, if the particles fill a cube evenly and all ranks have as many.
/// @param ranks    at least 1
/// @param latency  of one message, s
StepOnRanks stepOnRanks(const StepOnOneRank& alone, int ranks, double latency = kLatency);

}  // namespace studies
