// The paper's Table 2 again: time per step against the number of particles, as published, by the paper's method here
// and now, and by the neighbor list; then on to a million. Called by `globular study scaling`, which writes what comes
// out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"
#include "studies/scaling/lammps.h"

namespace studies {

/// A row of Table 2: milliseconds per frame of the paper's program, which takes one step a frame.
struct PublishedRow {
    std::size_t particles = 0;
    double milliseconds = 0.0;
};

/// Source: Cote 2024, Table 2 (GeForce RTX 4080, Ryzen 7 at 3.4 GHz).
extern const std::vector<PublishedRow> kTable2;

struct ScalingSettings {
    std::vector<std::size_t> cubeSizes = {1000, 2000, 5000, 10000, kPeerParticles, 100000, 320000, 1000000};
    std::size_t mostInScenes = 2000;      ///< rows of Table 2 up to this number
    std::size_t mostByEveryPair = 10000;  ///< beyond it every pair is not visited
    int rounds = 5;                       ///< medians of so many
    double secondsPerRound = 0.1;         ///< at least; one step takes as long as it takes
};

/// Seconds of one step.
struct ScalingRow {
    std::string subject;  ///< the scene, or the material of a block
    std::size_t particles = 0;
    double neighbors = 0.0;           ///< mean number within the cutoff
    std::optional<double> published;  ///< of the paper's program on its machine
    std::optional<double> everyPair;  ///< the paper's method
    double list = 0.0;                ///< with neighbor lists, rebuilt as the motion asks
    double listInFloat = 0.0;         ///< the same with forces in float
    std::string stateHash;            ///< after the steps that `list` was measured on
};

/// How time grows: seconds ~ N^exponent, by least squares of the logarithms over the rows from so many particles on.
struct ScalingFit {
    std::string subject;
    std::string method;  ///< "every pair", "list", "list in float"
    std::size_t from = 0;
    std::size_t to = 0;
    double exponent = 0.0;
};

/// What is told of each row as it is done.
using ScalingListener = std::function<void(const ScalingRow&)>;

/// A figure's scene at each particle count of Table 2: it runs on, its emitters unlimited, until it holds that many.
/// Steps are the paper's, 0.01 s with its stepper. Shape: the emitters go on giving birth. Throws:
/// engine::InstabilityError.
std::vector<ScalingRow> measureScene(const std::string& name, const scenes::Scene& scene,
                                     const ScalingSettings& settings, const ScalingListener& listener);

/// Close packings of a material at its rest length, moving, in space without gravity.
std::vector<ScalingRow> measureCubes(const std::string& material, const ScalingSettings& settings,
                                     const ScalingListener& listener);

/// Fits of the rows of one subject; a method that has fewer than two sizes has none.
std::vector<ScalingFit> fitsOf(const std::vector<ScalingRow>& rows);

/// Table as comma-separated values, with a head.
std::string scalingCsv(const std::vector<ScalingRow>& rows);
std::string fitsCsv(const std::vector<ScalingFit>& fits);

/// gnuplot script: milliseconds per step against particles, doubly logarithmic.
std::string scalingPlot(const std::vector<ScalingRow>& rows);

}  // namespace studies
