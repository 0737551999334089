// How fast the engine's parts run, each with the hash of what it computed: forces, lists, steps, and two loops that
// show what the machine could do. Called by `globular bench`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/advance.h"

namespace studies {

/// One thing measured.
struct BenchRow {
    std::string
        name;  ///< "forces", "list", "step velocity-verlet", "simulate frame", "draw frame", "multiply-add", "copy"
    std::string material;  ///< and how it is packed, where not at its rest length; a frame's scene; empty where none
    std::size_t particles = 0;
    double neighbors = 0.0;  ///< mean number within the cutoff; 0 where no pair is looked at
    engine::Precision precision = engine::Precision::doubles;
    double seconds = 0.0;           ///< of one pass, step or frame: the median over the rounds
    double steps = 1.0;             ///< within these seconds, mean over the rounds
    double bytesPerParticle = 0.0;  ///< of the lists and records that it reads; 0 where not counted
    double rate = 0.0;              ///< of the machine's loops: operations or bytes a second
    std::string stateHash;          ///< of the forces or the state at the end

    double particleStepsPerSecond() const;  ///< 0 for the machine's loops; of a drawing particles a second
    double pairsPerSecond() const;          ///< ordered pairs within the cutoff
    double nanosecondsPerPair() const;      ///< 0 where no pair is looked at
};

struct BenchSettings {
    std::string filter;  ///< rows whose name and material contain it
    std::vector<std::size_t> counts = {1000, 2000, 10000, 32000, 100000, 1000000};
    double secondsPerRound = 0.1;
    int rounds = 5;

    bool wants(const std::string& name, const std::string& material) const {
        return (name + " " + material).find(filter) != std::string::npos;
    }
};

/// Measures row after row on the threads of the calling arena, telling of each as it is done.
std::vector<BenchRow> runBench(const BenchSettings& settings, const std::function<void(const BenchRow&)>& listener);

}  // namespace studies
