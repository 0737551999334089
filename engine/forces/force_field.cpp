// Finds the terms of the force law and the cutoff that a set of materials and radii needs.
#include "engine/forces/force_field.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "engine/core/parallel.h"

namespace engine {
namespace {

bool sameLaw(const Material& a, const Material& b) {
    return a.repulsion == b.repulsion && a.damping == b.damping && a.repulsionReach == b.repulsionReach &&
           a.dampingReach == b.dampingReach && a.friction == b.friction && a.coreFraction == b.coreFraction &&
           a.pull == b.pull && a.restRatio == b.restRatio;
}

/// Compares the bits of the array with those of the array shifted by one number. A loop that compares numbers would
/// take a tenth as long as the forces in a scene of powder.
bool allEqual(const std::vector<double>& numbers) {
    if (numbers.size() < 2) return true;
    constexpr std::size_t kGrain = 1U << 16;  // fewest numbers a thread; chosen: half a megabyte
    return holdsInRanges(numbers.size() - 1, kGrain, [&](std::size_t begin, std::size_t end) {
        const double* const first = numbers.data() + begin;
        return std::memcmp(first, first + 1, (end - begin) * sizeof(double)) == 0;
    });
}

/// The largest of some numbers above 0; 0 if there are none. Eight running maxima take a vector instruction for several
/// numbers; std::max_element would take some hundredths of the time of the forces.
double largestOf(const std::vector<double>& numbers) {
    std::array<double, 8> largest = {};
    const std::size_t whole = numbers.size() - numbers.size() % largest.size();
    for (std::size_t k = 0; k < whole; k += largest.size())
        for (std::size_t lane = 0; lane < largest.size(); ++lane)
            largest[lane] = largest[lane] < numbers[k + lane] ? numbers[k + lane] : largest[lane];
    for (std::size_t k = whole; k < numbers.size(); ++k) largest[0] = std::max(largest[0], numbers[k]);
    return *std::ranges::max_element(largest);
}

}  // namespace

std::vector<Material> tabulatedMixtures(const std::vector<Material>& materials) {
    std::vector<Material> mixtures;
    if (materials.size() > kMostTabulated) return mixtures;
    mixtures.reserve(tabulatedCount(materials.size()));
    for (const Material& a : materials)
        for (const Material& b : materials) mixtures.push_back(tabulated(a, b));
    return mixtures;
}

Material tabulated(const Material& a, const Material& b) {
    return sameLaw(a, b) ? a : mixed(a, b);
}

bool isOneLaw(const std::vector<Material>& materials) {
    return std::ranges::all_of(materials, [&](const Material& m) { return sameLaw(m, materials.front()); });
}

double cutoffRatio(const std::vector<Material>& materials) {
    double ratio = 0.0;
    for (const Material& material : materials) {
        // The reaches of a mixture lie between the reaches of its two materials.
        ratio = std::max(ratio, material.repulsionReach * material.restRatio);
        if (material.pull > 0.0) ratio = std::max(ratio, kPullReach);
        if (material.damping > 0.0) ratio = std::max(ratio, material.dampingReach);
        if (material.thermal.exists()) ratio = std::max(ratio, kConductingReach);
    }
    return ratio;
}

ForceTerms termsFor(const ForceField& field, const Particles& particles, const Ranks& ranks) {
    ForceTerms terms;
    terms.oneLaw = isOneLaw(field.materials);
    terms.pair.equalReach = true;  // reaches that are equal in every material are equal in every mixture
    for (const Material& material : field.materials) {
        terms.pair.attraction |= material.repulsionReach > 1.0;
        terms.pair.damping |= material.damping > 0.0;
        terms.pair.friction |= material.friction > 0.0;
        terms.pair.cohesion |= material.pull > 0.0;
        if (material.damping > 0.0) terms.pair.equalReach &= material.repulsionReach == material.dampingReach;
    }
    const std::vector<double>& radii = particles.radius;
    terms.oneRadius = allEqual(radii);
    double largest = radii.empty() ? 0.0 : terms.oneRadius ? radii.front() : largestOf(radii);
    if (ranks.areMany()) {
        // Radii are equal if the largest of every rank's largest radii is also the smallest.
        constexpr double kNone = std::numeric_limits<double>::infinity();
        std::array bounds = {largest, radii.empty() ? -kNone : -largest, terms.oneRadius ? 0.0 : 1.0};
        ranks.maximize(bounds);
        largest = bounds[0];
        terms.oneRadius = bounds[2] == 0.0 && (bounds[1] == -kNone || bounds[1] == -largest);
    }
    terms.largestRadius = largest;
    terms.cutoff = cutoffRatio(field.materials) * 2.0 * largest;
    return terms;
}

}  // namespace engine
