// Measures how fast forces, neighbor lists, steps and whole frames run, each with a hash of what was computed, and two
// loops that show the limits of the machine: a multiply-add and a copy. Called by `globular bench`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "render/renderer.h"
#include "scenes/model/scene.h"

namespace studies {

inline constexpr const char* kSimulateFrame = "simulate frame";
inline constexpr const char* kDrawFrame = "draw frame";

/// One measurement of the benchmark.
struct BenchRow {
    /// What was measured: "forces", "list", "step velocity-verlet" (or another stepper), kSimulateFrame, kDrawFrame,
    /// "draw 1000 triangles" (or another number), "multiply-add" or "copy".
    std::string name;
    std::string material;  ///< lattice or scene that was measured on; empty for the machine's loops
    std::size_t particles = 0;
    double neighbors = 0.0;  ///< mean number of neighbors within the cutoff; 0 if the work does not visit pairs
    engine::Precision precision = engine::Precision::doubles;
    double seconds = 0.0;           ///< median time of one evaluation, build, step or frame
    double steps = 1.0;             ///< number of steps within the measured time, mean over the rounds
    double bytesPerParticle = 0.0;  ///< size of the neighbor list and of the packed particles; 0 if not counted
    double rate = 0.0;              ///< operations or bytes per second of the machine's loops; else 0
    std::string stateHash;          ///< hash of the computed forces, list or state

    /// Particles times steps per second; for kDrawFrame, drawn particles per second.
    double particleStepsPerSecond() const { return static_cast<double>(particles) * steps / seconds; }
    /// Visits per second of pairs within the cutoff, two for each pair in a step.
    double pairsPerSecond() const { return neighbors * particleStepsPerSecond(); }
    /// Nanoseconds per visit of a pair; 0 if the work does not visit pairs.
    double nanosecondsPerPair() const { return particles == 0 || neighbors == 0.0 ? 0.0 : 1e9 / pairsPerSecond(); }
};

struct BenchSettings {
    std::string filter;  ///< text that the name and material of a measurement, joined by a space, must contain
    std::vector<std::size_t> counts = {1000, 2000, 10000, 32000, 100000, 1000000};
    double secondsPerRound = 0.1;
    int rounds = 5;

    bool wants(const std::string& name, const std::string& material) const {
        return (name + " " + material).find(filter) != std::string::npos;
    }
};

/// Makes all wanted measurements except those of whole frames, on the threads of the calling oneTBB arena, and calls
/// the listener with each of them when it is done.
std::vector<BenchRow> runBench(const BenchSettings& settings, const std::function<void(const BenchRow&)>& listener);

/// The names and materials of all measurements of runBench(), for the error message about a filter that finds none.
std::string benchRowsText();

/// Measures simulating and drawing whole frames of a scene (kSimulateFrame and kDrawFrame): medians over the `rounds`
/// frames that follow the scene's still, drawn in the scene's own appearance. The hash is that of the last state.
/// @param renderer  draws pictures of the scene's size; null: frames are simulated only
/// @throws engine::InstabilityError, render::SystemError
std::vector<BenchRow> benchFrames(const std::string& name, const scenes::Scene& scene, render::Renderer* renderer,
                                  int rounds);

/// Runs fused multiply-adds in registers, on vectors as wide as the machine's and on the given number of threads.
/// Measures the machine's peak of floating-point operations.
/// @param sink  receives a result, so that the compiler cannot drop the work
/// @return  number of floating-point operations done
double multiplyAdd(std::size_t threads, std::size_t rounds, float& sink);

}  // namespace studies
