// Interpolates between the constants of a solid and a melt.
#include "engine/force_law/melting.h"

#include <cmath>

namespace engine {
namespace {

/// A stage of a number of equal stages.
struct Stage {
    std::uint32_t number = 0;
    std::uint32_t count = 1;  ///< a power of two
};

double between(double solid, double melt, const Stage& stage) {
    return solid + stage.number * (melt - solid) / stage.count;
}

/// Halves the way again and again, since square roots have the same bits on every machine.
double geometricBetween(double solid, double melt, Stage stage) {
    if (!(solid > 0.0 && melt > 0.0)) return between(solid, melt, stage);
    while (stage.number > 0 && stage.number < stage.count) {
        const double middle = std::sqrt(solid * melt);
        stage.count /= 2;
        const bool isBeyond = stage.number >= stage.count;
        if (isBeyond) stage.number -= stage.count;
        (isBeyond ? solid : melt) = middle;
    }
    return stage.number == 0 ? solid : melt;
}

}  // namespace

std::vector<Material> stagesOf(const Material& solid, const Material& melt, std::uint32_t count) {
    std::vector<Material> stages;
    for (std::uint32_t k = 1; k < count; ++k) {
        const Stage at{k, count};
        Material stage = solid;
        stage.repulsion = geometricBetween(solid.repulsion, melt.repulsion, at);
        stage.damping = geometricBetween(solid.damping, melt.damping, at);
        stage.repulsionReach = between(solid.repulsionReach, melt.repulsionReach, at);
        stage.dampingReach = between(solid.dampingReach, melt.dampingReach, at);
        stage.friction = between(solid.friction, melt.friction, at);
        stage.coreFraction = between(solid.coreFraction, melt.coreFraction, at);
        stage.cohesion = between(solid.cohesion, melt.cohesion, at);
        stage.agitation = between(solid.agitation, melt.agitation, at);
        stage.pull = between(solid.pull, melt.pull, at);
        stage.restRatio = between(solid.restRatio, melt.restRatio, at);
        stages.push_back(stage);
    }
    Material last = melt;
    last.radius = solid.radius;
    last.mass = solid.mass;
    last.thermal = solid.thermal;
    stages.push_back(last);
    return stages;
}

std::uint32_t stageAt(const Melt& melt, double share) {
    const auto stage = static_cast<std::uint32_t>(std::lround(share * melt.count));
    return stage == 0 ? melt.solid : melt.first + stage - 1;
}

bool isStage(const Melt& melt, std::uint32_t material) {
    return material == melt.solid || (material >= melt.first && material - melt.first < melt.count);
}

}  // namespace engine
