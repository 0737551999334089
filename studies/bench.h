// How fast the engine's parts run, each with the hash of what it computed: forces, lists, steps, and two loops that
// show what the machine could do. Called by `globular bench`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/simulation.h"

namespace studies {

/// One thing measured.
struct BenchRow {
    std::string name;      ///< "forces", "list", "step velocity-verlet", "multiply-add", "copy"
    std::string material;  ///< and how it is packed, where not at its rest length; empty where there is none
    std::size_t particles = 0;
    double neighbours = 0.0;  ///< mean number within the cutoff
    engine::Precision precision = engine::Precision::doubles;
    double seconds = 0.0;           ///< of one pass, step or frame: the median over the rounds
    double bytesPerParticle = 0.0;  ///< of the lists and records that it reads; 0 where not counted
    double rate = 0.0;              ///< of the machine's loops: operations or bytes a second
    std::string stateHash;          ///< of the forces or the state at the end

    double particleStepsPerSecond() const;  ///< 0 for the machine's loops
    double pairsPerSecond() const;          ///< ordered pairs within the cutoff
    double nanosecondsPerPair() const;
};

struct BenchSettings {
    std::string filter;  ///< rows whose name and material contain it
    std::vector<std::size_t> counts = {1000, 2000, 10000, 32000, 100000, 1000000};
    double secondsPerRound = 0.1;
    int rounds = 5;
};

/// Measures row after row on the threads of the calling arena, telling of each as it is done.
std::vector<BenchRow> runBench(const BenchSettings& settings, const std::function<void(const BenchRow&)>& listener);

}  // namespace studies
