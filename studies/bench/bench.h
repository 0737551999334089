// How fast forces, neighbor lists, steps and whole frames run, each with a hash of what was computed, beside two loops
// that show the machine's limits. Called by `globular bench`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "render/opengl/context.h"
#include "scenes/model/scene.h"

namespace studies {

inline constexpr const char* kSimulateFrame = "simulate frame";
inline constexpr const char* kDrawFrame = "draw frame";

/// One measurement.
struct BenchRow {
    /// "forces", "list", "step velocity-verlet", kSimulateFrame, kDrawFrame, "multiply-add" or "copy".
    std::string name;
    std::string material;  ///< the lattice's material and, if not at rest length, packing; or the scene; or empty
    std::size_t particles = 0;
    double neighbors = 0.0;  ///< mean number within the cutoff; 0 if the work does not visit pairs
    engine::Precision precision = engine::Precision::doubles;
    double seconds = 0.0;           ///< of one evaluation, build, step or frame: the median over the rounds
    double steps = 1.0;             ///< number of steps within these seconds, mean over the rounds
    double bytesPerParticle = 0.0;  ///< of the lists and records that are read; 0 where not counted
    double rate = 0.0;              ///< of the machine's loops: operations or bytes per second
    std::string stateHash;          ///< of the forces, the list or the state at the end

    double particleStepsPerSecond() const;  ///< for kDrawFrame, particles per second; 0 for the machine's loops
    double pairsPerSecond() const;          ///< ordered pairs within the cutoff
    double nanosecondsPerPair() const;      ///< 0 if the work does not visit pairs
};

struct BenchSettings {
    std::string filter;  ///< rows whose name and material, joined by a space, contain it
    std::vector<std::size_t> counts = {1000, 2000, 10000, 32000, 100000, 1000000};
    double secondsPerRound = 0.1;
    int rounds = 5;

    bool wants(const std::string& name, const std::string& material) const {
        return (name + " " + material).find(filter) != std::string::npos;
    }
};

/// Measures the wanted rows but those of whole frames, on the threads of the calling arena, and reports each one as it
/// is done.
std::vector<BenchRow> runBench(const BenchSettings& settings, const std::function<void(const BenchRow&)>& listener);

/// The names and materials of the rows that runBench() can measure, in words, for the error message about a filter that
/// finds none.
std::string benchRowsText();

/// Two rows, kSimulateFrame and kDrawFrame: medians over the `rounds` frames that follow the scene's still, drawn with
/// the scene's own appearance and size at normal quality. The hash is that of the last state.
/// @param context  to draw with; without one the first row is the only one
/// @throws engine::InstabilityError, render::SystemError
std::vector<BenchRow> benchFrames(const std::string& name, const scenes::Scene& scene, render::Context* context,
                                  int rounds);

/// Multiplies and adds in registers, with as many lanes as the machine's vectors have, on the given number of threads.
/// @param sink  receives a result, so that the compiler cannot drop the work
/// @return  number of floating-point operations done
double multiplyAdd(std::size_t threads, std::size_t rounds, float& sink);

}  // namespace studies
