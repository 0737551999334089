// The terms and the cutoff that materials and radii ask for.
#include "engine/force_law.h"

#include <algorithm>

namespace engine {
namespace {

bool sameLaw(const Material& a, const Material& b) {
    return a.repulsion == b.repulsion && a.damping == b.damping && a.repulsionReach == b.repulsionReach &&
           a.dampingReach == b.dampingReach && a.friction == b.friction && a.coreFraction == b.coreFraction;
}

}  // namespace

std::vector<Material> mixedPairs(const std::vector<Material>& materials) {
    std::vector<Material> pairs;
    for (const Material& a : materials)
        for (const Material& b : materials) pairs.push_back(sameLaw(a, b) ? a : mixed(a, b));
    return pairs;
}

double reachOf(const std::vector<Material>& materials) {
    double reach = 0.0;
    for (const Material& material : materials) {
        // The mix's reaches lie between those of its parts.
        reach = std::max(reach, material.repulsionReach);
        if (material.damping > 0.0) reach = std::max(reach, material.dampingReach);
    }
    return reach;
}

ForceTerms termsFor(const ForceLaw& law, const Particles& particles) {
    ForceTerms terms;
    for (const Material& material : law.materials) {
        terms.pair.attraction |= material.repulsionReach > 1.0;
        terms.pair.damping |= material.damping > 0.0;
        terms.pair.friction |= material.friction > 0.0;
        terms.uniform &= sameLaw(material, law.materials.front());
    }
    double largestRadius = 0.0;
    for (const double radius : particles.radius) {
        terms.uniform &= radius == particles.radius.front();
        largestRadius = std::max(largestRadius, radius);
    }
    terms.cutoff = reachOf(law.materials) * 2.0 * largestRadius;
    return terms;
}

}  // namespace engine
