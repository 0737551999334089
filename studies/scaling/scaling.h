// Repeats the paper's Table 2 and goes beyond it: measures the time per step against the number of particles by the
// paper's method on this machine and with neighbor lists, up to a million particles, and compares the speed with
// LAMMPS. Called by `globular study scaling`, which writes the results.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// The run of LAMMPS that is timed: the number of particles in its periodic cube, the mean number of neighbors within
/// its cutoff (about as many as in our cubes), and its number of steps.
inline constexpr std::size_t kPeerParticles = 32000;
inline constexpr double kPeerNeighbors = 45.0;
inline constexpr int kPeerSteps = 200;

struct ScalingSettings {
    std::vector<std::size_t> cubeSizes = {1000, 2000, 5000, 10000, kPeerParticles, 100000, 320000, 1000000};
    std::size_t mostInScenes = 2000;      ///< largest number of particles of Table 2 that is measured
    std::size_t mostByEveryPair = 10000;  ///< largest number of particles that the paper's method is measured with
    int rounds = 5;                       ///< number of rounds that medians are taken of
    double secondsPerRound = 0.1;         ///< least time of a round, s; a round repeats its steps until then
};

/// Times of a step (s) by several methods at one number of particles.
struct ScalingRow {
    std::string subject;  ///< name of the scene, or material of the cube
    std::size_t particles = 0;
    double neighbors = 0.0;           ///< mean number of neighbors within the cutoff
    std::optional<double> published;  ///< time of the paper's program on its author's machine
    std::optional<double> everyPair;  ///< time by the paper's method, which visits every pair
    double list = 0.0;                ///< time with neighbor lists, including their rebuilds
    double listInFloat = 0.0;         ///< time with neighbor lists and forces in single precision
    std::string stateHash;            ///< hash of the state after the steps with neighbor lists
};

/// Growth of the time per step by one method with the number N of particles: a fit of seconds ~ N^exponent.
struct ScalingFit {
    std::string subject;
    std::string method;    ///< "every pair", "list" or "list in float"
    std::size_t from = 0;  ///< smallest number of particles in the fit
    std::size_t to = 0;    ///< largest number of particles in the fit
    double exponent = 0.0;
};

/// Called with the times at each number of particles when they are measured.
using ScalingListener = std::function<void(const ScalingRow&)>;

/// Measures the scene of one of the paper's figures at each number of particles in Table 2. The scene runs until it
/// holds that many particles, with unlimited emitters, by the paper's stepper at the paper's step of 0.01 s.
/// @pre the scene's emitters do not run dry
/// @throws engine::InstabilityError
std::vector<ScalingRow> measureScene(const std::string& name, const scenes::Scene& scene,
                                     const ScalingSettings& settings, const ScalingListener& listener);

/// Measures cubes of moving particles of a material, on a lattice at the rest length and without gravity.
std::vector<ScalingRow> measureCubes(const std::string& material, const ScalingSettings& settings,
                                     const ScalingListener& listener);

/// Fits the growth of the time for each method, to the rows of one scene or material. Methods that were measured with
/// fewer than two numbers of particles have no fit.
std::vector<ScalingFit> fitsOf(const std::vector<ScalingRow>& rows);

/// The tables of the study as CSV with a header line.
std::string scalingCsv(const std::vector<ScalingRow>& rows);
std::string fitsCsv(const std::vector<ScalingFit>& fits);

/// A gnuplot script for a plot of milliseconds per step against the number of particles, on logarithmic axes.
std::string scalingPlot(const std::vector<ScalingRow>& rows);

/// Pair forces of LAMMPS: Lennard-Jones in its optimized form, and dissipative particle dynamics, which damps the
/// relative velocity along the pair as the paper's law does.
enum class PeerForce { lennardJones, dissipative };

std::string nameOf(PeerForce force);

/// The input script for LAMMPS: a cube melts, then kPeerSteps steps are timed, with lists rebuilt by displacement.
std::string lammpsScript(PeerForce force);

/// Time of the timed steps according to LAMMPS' output, s; nothing if the output does not say.
std::optional<double> lammpsSeconds(const std::string& output);

/// The line of LAMMPS' output that reports an error; empty if there is none.
std::string lammpsError(const std::string& output);

/// The speed of LAMMPS with one of its pair forces.
struct PeerRow {
    std::string name;
    double secondsPerStep = 0.0;  ///< time per step of LAMMPS
    double ratio = 0.0;           ///< our particle-steps per second over those of LAMMPS, in double precision
    double ratioInFloat = 0.0;    ///< our particle-steps per second over those of LAMMPS, in single precision

    double particleStepsPerSecond() const { return kPeerParticles / secondsPerStep; }
};

}  // namespace studies
