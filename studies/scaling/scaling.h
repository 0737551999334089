// The paper's Table 2 again, and beyond: time per step against the number of particles, as published, by the paper's
// method on this machine, and with neighbor lists, up to a million particles; and LAMMPS as a peer to compare with.
// Called by `globular study scaling`, which writes the results.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// Particles of LAMMPS' periodic cube, mean number of neighbors within its cutoff (about as many as in our cubes), and
/// steps of the run that is timed.
inline constexpr std::size_t kPeerParticles = 32000;
inline constexpr double kPeerNeighbors = 45.0;
inline constexpr int kPeerSteps = 200;

struct ScalingSettings {
    std::vector<std::size_t> cubeSizes = {1000, 2000, 5000, 10000, kPeerParticles, 100000, 320000, 1000000};
    std::size_t mostInScenes = 2000;      ///< rows of Table 2 with more particles are left out
    std::size_t mostByEveryPair = 10000;  ///< the paper's method is measured up to this number of particles
    int rounds = 5;                       ///< times are medians over the rounds
    double secondsPerRound = 0.1;         ///< a round repeats its steps until it has taken this long
};

/// Seconds per step at one number of particles.
struct ScalingRow {
    std::string subject;  ///< the scene, or the material of a cube
    std::size_t particles = 0;
    double neighbors = 0.0;           ///< mean number within the cutoff
    std::optional<double> published;  ///< by the paper's program on its author's machine
    std::optional<double> everyPair;  ///< by the paper's method, which visits every pair
    double list = 0.0;                ///< with neighbor lists, including their rebuilds
    double listInFloat = 0.0;         ///< with neighbor lists and forces in single precision
    std::string stateHash;            ///< after the steps that `list` was measured on
};

/// Growth of the time with the number N of particles, seconds ~ N^exponent, fitted over the rows of one method.
struct ScalingFit {
    std::string subject;
    std::string method;    ///< "every pair", "list" or "list in float"
    std::size_t from = 0;  ///< number of particles of the first row
    std::size_t to = 0;    ///< number of particles of the last row
    double exponent = 0.0;
};

/// Called with each row when it is done.
using ScalingListener = std::function<void(const ScalingRow&)>;

/// Measures a figure's scene at each particle count of Table 2. The scene runs, with emitters without limit, until it
/// holds that many particles, by the paper's stepper at the paper's step of 0.01 s.
/// @pre the scene's emitters do not run dry
/// @throws engine::InstabilityError
std::vector<ScalingRow> measureScene(const std::string& name, const scenes::Scene& scene,
                                     const ScalingSettings& settings, const ScalingListener& listener);

/// Measures moving face-centered cubic lattices of a material at its rest length, in space without gravity.
std::vector<ScalingRow> measureCubes(const std::string& material, const ScalingSettings& settings,
                                     const ScalingListener& listener);

/// Fits of the rows of one subject; none for a method with fewer than two sizes.
std::vector<ScalingFit> fitsOf(const std::vector<ScalingRow>& rows);

/// CSV with a header line.
std::string scalingCsv(const std::vector<ScalingRow>& rows);
std::string fitsCsv(const std::vector<ScalingFit>& fits);

/// A gnuplot script: milliseconds per step against particles, on logarithmic axes.
std::string scalingPlot(const std::vector<ScalingRow>& rows);

/// Pair forces of LAMMPS: Lennard-Jones in its optimized form, and dissipative particle dynamics, which damps the
/// relative velocity along the pair as the paper's law does.
enum class PeerForce { lennardJones, dissipative };

std::string nameOf(PeerForce force);

/// Input for LAMMPS: a cube of kPeerParticles that melts, then kPeerSteps with lists rebuilt by displacement.
std::string lammpsScript(PeerForce force);

/// Seconds of the loop of kPeerSteps according to LAMMPS' output; nothing if the output does not say.
std::optional<double> lammpsSeconds(const std::string& output);

/// The line of LAMMPS' output that reports an error; empty if there is none.
std::string lammpsError(const std::string& output);

/// The speed of one force of LAMMPS.
struct PeerRow {
    std::string name;
    double secondsPerStep = 0.0;
    double ratio = 0.0;         ///< our particle-steps per second over LAMMPS', in double precision
    double ratioInFloat = 0.0;  ///< the same ratio with our forces in single precision

    double particleStepsPerSecond() const { return kPeerParticles / secondsPerStep; }
};

}  // namespace studies
