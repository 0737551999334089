// A particle's class is the number of times that its radius can be doubled without exceeding the largest radius.
#include "engine/neighbors/size_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace engine {
namespace {

/// Number of doublings from which on all particles are in one class. Chosen: no scene has such sizes.
constexpr int kMostDoublings = 63;

std::size_t doublingsOf(double radius, double largest) {
    return static_cast<std::size_t>(std::min(std::ilogb(largest / radius), kMostDoublings));
}

}  // namespace

SizeTable sizesOf(const Ranks& ranks, std::span<const double> radii) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array largestAndSmallest = {0.0, -kInfinity};  // the smallest with a minus, for maximize()
    for (const double radius : radii) {
        largestAndSmallest[0] = std::max(largestAndSmallest[0], radius);
        largestAndSmallest[1] = std::max(largestAndSmallest[1], -radius);
    }
    ranks.maximize(largestAndSmallest);
    const double largest = largestAndSmallest[0];
    SizeTable sizes;
    sizes.classes[0].largestRadius = largest;
    sizes.areEqual = largest == 0.0 || largest == -largestAndSmallest[1];
    if (!(largest >= -2.0 * largestAndSmallest[1])) return sizes;

    std::array<double, kMostDoublings + 1> largestOf = {};
    std::array<std::int64_t, kMostDoublings + 1> counts = {};
    for (const double radius : radii) {
        const std::size_t doublings = doublingsOf(radius, largest);
        largestOf.at(doublings) = std::max(largestOf.at(doublings), radius);
        ++counts.at(doublings);
    }
    ranks.maximize(largestOf);
    ranks.sum(counts);
    sizes.classes.clear();
    for (std::size_t k = 0; k < counts.size(); ++k)
        sizes.classes.push_back({largestOf.at(k), static_cast<std::uint64_t>(counts.at(k))});
    return sizes;
}

double typicalRelativeRadius(const SizeTable& sizes) {
    if (sizes.areSimilar()) return 1.0;
    const auto byCount = [](const auto& one, const auto& other) { return one.count < other.count; };
    return std::ranges::max_element(sizes.classes, byCount)->largestRadius / sizes.largestRadius();
}

void divideBySize(const SizeTable& sizes, std::span<const double> radii, std::size_t count,
                  std::vector<SizeClass>& classes) {
    std::map<std::size_t, std::vector<std::uint32_t>> membersOf;
    if (!sizes.areSimilar())
        for (std::uint32_t p = 0; p < count; ++p) membersOf[doublingsOf(radii[p], sizes.largestRadius())].push_back(p);
    if (membersOf.empty()) membersOf.emplace();  // one class, whose members need not be listed
    classes.resize(membersOf.size());
    std::uint32_t begin = 0;
    auto next = classes.begin();
    for (auto& [doublings, members] : membersOf) {
        const std::size_t size = sizes.areSimilar() ? count : members.size();
        next->relativeRadius =
            sizes.areSimilar() ? 1.0 : sizes.classes[doublings].largestRadius / sizes.largestRadius();
        next->sorted = {begin, begin + static_cast<std::uint32_t>(size)};
        next->members = std::move(members);
        begin = next->sorted.end;
        ++next;
    }
}

void buildGrid(SizeClass& sizeClass, const std::vector<Vec3>& positions, double cellWidth) {
    if (sizeClass.members.empty()) return build(sizeClass.grid, positions, cellWidth);
    std::vector<Vec3> own;
    own.reserve(sizeClass.members.size());
    for (const std::uint32_t p : sizeClass.members) own.push_back(positions[p]);
    build(sizeClass.grid, own, cellWidth);
}

}  // namespace engine
