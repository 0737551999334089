// A particle's class is the number of times that its radius can be doubled without exceeding the largest radius.
#include "engine/neighbors/size_classes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace engine {
namespace {

/// Particle indices of each class by the class' number of doublings. Empty if all particles are of similar size.
std::map<int, std::vector<std::uint32_t>> membersBySize(std::span<const double> radii) {
    std::map<int, std::vector<std::uint32_t>> members;
    if (radii.empty()) return members;
    const auto [smallest, largest] = std::ranges::minmax(radii);
    if (!(largest >= 2.0 * smallest)) return members;
    for (std::uint32_t p = 0; p < radii.size(); ++p) members[std::ilogb(largest / radii[p])].push_back(p);
    return members;
}

double largestOf(std::span<const double> radii, const std::vector<std::uint32_t>& members) {
    double largest = 0.0;
    for (const std::uint32_t p : members) largest = std::max(largest, radii[p]);
    return largest;
}

}  // namespace

void divideBySize(std::span<const double> radii, std::size_t count, std::vector<SizeClass>& classes) {
    auto membersOf = membersBySize(radii);
    if (membersOf.empty()) membersOf.emplace();  // one class, whose members need not be listed
    classes.resize(membersOf.size());
    const double largest = membersOf.size() == 1 ? 1.0 : *std::ranges::max_element(radii);
    std::uint32_t begin = 0;
    auto next = classes.begin();
    for (auto& [doublings, members] : membersOf) {
        const std::size_t size = members.empty() ? count : members.size();
        next->relativeRadius = members.empty() ? 1.0 : largestOf(radii, members) / largest;
        next->sorted = {begin, begin + static_cast<std::uint32_t>(size)};
        next->members = std::move(members);
        begin = next->sorted.end;
        ++next;
    }
}

double typicalRelativeRadius(std::span<const double> radii) {
    const auto membersOf = membersBySize(radii);
    if (membersOf.empty()) return 1.0;
    const auto bySize = [](const auto& one, const auto& other) { return one.second.size() < other.second.size(); };
    const auto& most = std::ranges::max_element(membersOf, bySize)->second;
    return largestOf(radii, most) / *std::ranges::max_element(radii);
}

void buildGrid(SizeClass& sizeClass, const std::vector<Vec3>& positions, double cellWidth) {
    if (sizeClass.members.empty()) return build(sizeClass.grid, positions, cellWidth);
    std::vector<Vec3> own;
    own.reserve(sizeClass.members.size());
    for (const std::uint32_t p : sizeClass.members) own.push_back(positions[p]);
    build(sizeClass.grid, own, cellWidth);
}

}  // namespace engine
