// A peer to measure against: what LAMMPS is asked to do, and what it says of the time. It is run by the caller.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace studies {

/// Pair forces of LAMMPS: Lennard-Jones in its optimized form, and dissipative particle dynamics, which is damped along
/// the pair like ours.
enum class PeerForce { lennardJones, dissipative };

std::string nameOf(PeerForce force);

/// Neighbors within the cutoff that the peer is given: about as many as a particle of our blocks has on the mean.
inline constexpr double kPeerNeighbors = 45.0;

/// Particles of the peer's periodic block, and steps of the run that is timed.
inline constexpr std::size_t kPeerParticles = 32000;
inline constexpr int kPeerSteps = 200;

/// Input for the program: a block that melts, then kPeerSteps with lists rebuilt by displacement.
std::string lammpsScript(PeerForce force);

/// Seconds of the loop of kPeerSteps that the program's output tells of; nothing if it tells of none.
std::optional<double> lammpsSeconds(const std::string& output);

/// The line of the program's output that tells of its own error; empty if there is none.
std::string lammpsError(const std::string& output);

/// What one force of the peer reached.
struct PeerRow {
    std::string name;
    std::size_t particles = kPeerParticles;
    double neighbors = kPeerNeighbors;
    double secondsPerStep = 0.0;
    double ratio = 0.0;         ///< of our particle-steps a second to the peer's, in double
    double ratioInFloat = 0.0;  ///< the same with our forces in float

    double particleStepsPerSecond() const { return static_cast<double>(particles) / secondsPerStep; }
};

}  // namespace studies
