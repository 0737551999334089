// Finds which particles the ranks send each other.
#include "engine/ranks/halo.h"

#include <algorithm>
#include <limits>

#include "engine/core/bounding_box.h"

namespace engine {
namespace {

/// The bounding boxes of all ranks' particles.
std::vector<BoundingBox> boxesOfRanks(const Ranks& ranks, const std::vector<Vec3>& positions) {
    const BoundingBox own = boundingBoxOf(positions.size(), [&](std::size_t p) -> const Vec3& { return positions[p]; });
    const std::vector<double> bounds =
        ranks.gatherAll({own.low.x(), own.low.y(), own.low.z(), own.high.x(), own.high.y(), own.high.z()});
    std::vector<BoundingBox> boxes;
    for (std::size_t k = 0; k < bounds.size(); k += 6)
        boxes.push_back({{bounds[k], bounds[k + 1], bounds[k + 2]}, {bounds[k + 3], bounds[k + 4], bounds[k + 5]}});
    return boxes;
}

/// The particles within a distance (m) of a box, and a few more.
std::vector<std::uint32_t> particlesNear(const BoundingBox& box, const std::vector<Vec3>& positions, double distance) {
    constexpr double kMargin = 1.0 + 1e-6;  // chosen: far above the rounding errors of distances
    const double nearSq = distance * distance * kMargin;
    std::vector<std::uint32_t> near;
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        const Vec3 away = (box.low - positions[p]).cwiseMax(positions[p] - box.high).cwiseMax(0.0);
        if (squaredLength(away) <= nearSq) near.push_back(p);
    }
    return near;
}

/// Whether two boxes are within a distance (m) of each other, or only a little further; not if one is empty.
bool areNear(const BoundingBox& one, const BoundingBox& other, double distance) {
    constexpr double kMargin = 1.0 + 1e-6;
    return ((one.low.array() - other.high.array()) <= distance * kMargin).all() &&
           ((other.low.array() - one.high.array()) <= distance * kMargin).all();
}

/// Sends the ids of the particles that others need of this rank; returns those that this rank gets, for each route.
std::vector<std::vector<std::uint32_t>> swapIds(const Ranks& ranks, std::span<const std::uint32_t> ids,
                                                const std::vector<Halo::Route>& routes) {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(ranks.count()));
    for (const Halo::Route& route : routes)
        numbers[static_cast<std::size_t>(route.rank)] = static_cast<std::int64_t>(route.own.size());
    numbers = ranks.swapNumbers(numbers);
    std::vector<std::size_t> counts;
    for (const Halo::Route& route : routes)
        counts.push_back(static_cast<std::size_t>(numbers[static_cast<std::size_t>(route.rank)]));
    return swapItems<std::uint32_t>(
        ranks, routes, [&](std::uint32_t p) { return ids[p]; }, counts);
}

}  // namespace

std::vector<std::size_t> ghostCounts(const Halo& halo) {
    std::vector<std::size_t> counts;
    for (const Halo::Route& route : halo.routes) counts.push_back(route.ghosts.size());
    return counts;
}

Halo findHalo(const Ranks& ranks, const std::vector<Vec3>& positions, std::span<const std::uint32_t> ids,
              double reach) {
    Halo halo;
    const std::vector<BoundingBox> boxes = boxesOfRanks(ranks, positions);
    const BoundingBox& own = boxes[static_cast<std::size_t>(ranks.own())];
    for (int rank = 0; rank < ranks.count(); ++rank) {
        const BoundingBox& other = boxes[static_cast<std::size_t>(rank)];
        if (rank != ranks.own() && areNear(own, other, reach))
            halo.routes.push_back({rank, particlesNear(other, positions, reach), {}});
    }
    const std::vector<std::vector<std::uint32_t>> ghostIds = swapIds(ranks, ids, halo.routes);

    halo.ids.assign(ids.begin(), ids.end());
    for (const auto& received : ghostIds) halo.ids.insert(halo.ids.end(), received.begin(), received.end());
    std::ranges::sort(halo.ids);
    const auto combinedIndex = [&](std::uint32_t id) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(halo.ids, id) - halo.ids.begin());
    };
    halo.isGhost.assign(halo.ids.size(), 1);
    halo.ownOf.assign(halo.ids.size(), 0);
    for (std::uint32_t p = 0; p < ids.size(); ++p) {
        halo.combinedIndexOf.push_back(combinedIndex(ids[p]));
        halo.ownOf[halo.combinedIndexOf.back()] = p;
        halo.isGhost[halo.combinedIndexOf.back()] = 0;
    }
    for (std::size_t k = 0; k < halo.routes.size(); ++k)
        for (const std::uint32_t id : ghostIds[k]) halo.routes[k].ghosts.push_back(combinedIndex(id));
    return halo;
}

}  // namespace engine
