// Writes LAMMPS' input script and reads the time from its output. The caller starts the program. See scaling.h.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "studies/scaling/scaling.h"

namespace studies {
namespace {

/// Number of unit cells of the face-centered cubic lattice, of four particles each, along each side of the cube.
constexpr int kSide = 20;
static_assert(4 * kSide * kSide * kSide == kPeerParticles);

/// The usual number density of a liquid with the given pair force, in LAMMPS' reduced units.
double densityOf(PeerForce force) {
    return force == PeerForce::lennardJones ? 0.8442 : 3.0;
}

}  // namespace

std::string nameOf(PeerForce force) {
    return force == PeerForce::lennardJones ? "lj/cut/opt" : "dpd";
}

std::string lammpsScript(PeerForce force) {
    // A sphere whose radius is the cutoff holds kPeerNeighbors particles.
    const double cutoff = std::cbrt(kPeerNeighbors / (4.0 / 3.0 * std::numbers::pi * densityOf(force)));
    const std::string style =
        force == PeerForce::lennardJones
            ? fmt::format("pair_style lj/cut/opt {:.4f}\npair_coeff 1 1 1.0 1.0\n", cutoff)
            : fmt::format("comm_modify mode single vel yes\npair_style dpd 1.0 {:.4f} 34387\npair_coeff 1 1 25.0 4.5\n",
                          cutoff);
    return fmt::format(
        "units lj\natom_style atomic\nlattice fcc {0}\nregion box block 0 {1} 0 {1} 0 {1}\ncreate_box 1 box\n"
        "create_atoms 1 box\nmass 1 1.0\nvelocity all create 1.44 87287\n{2}neighbor 0.3 bin\n"
        "neigh_modify delay 0 every 1 check yes\nfix 1 all nve\nthermo 1000\nrun 100\nrun {3}\n",
        densityOf(force), kSide, style, kPeerSteps);
}

std::optional<double> lammpsSeconds(const std::string& output) {
    constexpr std::string_view kBefore = "Loop time of ";
    const std::string steps = fmt::format(" for {} steps", kPeerSteps);
    const std::size_t at = output.rfind(kBefore);
    if (at == std::string::npos || output.find(steps, at) == std::string::npos) return std::nullopt;
    double seconds = 0.0;
    std::from_chars(output.data() + at + kBefore.size(), output.data() + output.size(), seconds);
    return seconds > 0.0 ? std::optional(seconds) : std::nullopt;
}

std::string lammpsError(const std::string& output) {
    const std::size_t at = output.find("ERROR");
    return at == std::string::npos ? std::string() : output.substr(at, output.find('\n', at) - at);
}

}  // namespace studies
