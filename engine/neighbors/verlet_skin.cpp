// A cost for each of some widths, counted in pairs; the least wins. Asked by PairTraversal::prepare, whenever a list is
// built.
#include "engine/neighbors/verlet_skin.h"

#include <array>
#include <cmath>
#include <limits>

namespace engine {
namespace {

/// Measured: rows "list" and "forces" of `globular bench` at 5 to 90 neighbors, between double and float. Building
/// costs as much as a pass over so many pairs for each particle, and so many more for each entry of its row.
constexpr double kPerParticle = 50.0;
constexpr double kPerEntry = 2.0;

/// Chosen: finer steps save nothing, wider skins take memory.
constexpr std::array kWidths = {0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6};

/// Of a step, in pairs for each particle.
double costOf(double skin, double neighbors, double way) {
    const double entries = neighbors * (1.0 + skin) * (1.0 + skin) * (1.0 + skin);
    const double passes = 1.0 + std::floor(0.5 * skin / way);
    return entries + (kPerParticle + kPerEntry * entries) / passes;
}

}  // namespace

double optimalSkin(double neighbors, double way) {
    double best = kWidths.front();
    double least = std::numeric_limits<double>::infinity();
    for (const double skin : kWidths) {
        const double cost = costOf(skin, neighbors, way);
        if (!(cost < least)) continue;  // what is no number is no choice
        best = skin;
        least = cost;
    }
    return best;
}

}  // namespace engine
