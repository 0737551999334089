// The halo of a rank: ghosts, which are the particles of other ranks within reach of its own. Found when a neighbor
// list is built; what they have is then fetched from their ranks before every pass over the list. Which particles a
// rank owns makes no difference to what is found, only to how much: ranks are told apart by the bounding boxes of their
// particles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/ranks/ranks.h"

namespace engine {

/// Own particles and ghosts together, in ascending order of their ids, and the ways between ranks. The index of a
/// particle in this order is its combined index.
struct Halo {
    /// What a rank sends to another one and receives from it.
    struct Route {
        int rank = 0;
        std::vector<std::uint32_t> own;     ///< indices of the particles that are sent
        std::vector<std::uint32_t> ghosts;  ///< combined indices of those received
    };

    std::vector<Route> routes;
    std::vector<std::uint32_t> ids;              ///< by combined index
    std::vector<std::uint32_t> combinedIndexOf;  ///< combined index of each own particle
    std::vector<std::uint32_t> ownOf;   ///< index of the own particle at each combined index; arbitrary for ghosts
    std::vector<std::uint8_t> isGhost;  ///< by combined index, 0 or 1
};

/// Finds the ghosts of all ranks.
/// @param positions  of the rank's particles, m
/// @param ids        of the rank's particles, ascending
/// @param reach      ghosts are at least the particles within this distance (m) of any particle of the rank
Halo findHalo(const Ranks& ranks, const std::vector<Vec3>& positions, std::span<const std::uint32_t> ids, double reach);

/// Numbers of ghosts that come along each route.
std::vector<std::size_t> ghostCounts(const Halo& halo);

/// Sends an item of each particle that other ranks need, along the routes, and returns those received from each route.
/// @param itemOf  itemOf(index) returns the item of an own particle; items are copied as bytes
/// @param counts  numbers of items to receive
template <class Item, class ItemOf>
std::vector<std::vector<Item>> swapItems(const Ranks& ranks, const std::vector<Halo::Route>& routes,
                                         const ItemOf& itemOf, const std::vector<std::size_t>& counts) {
    std::vector<std::vector<Item>> toSend(routes.size());
    std::vector<std::vector<Item>> received(routes.size());
    std::vector<Message<const std::byte>> sends;
    std::vector<Message<std::byte>> receives;
    for (std::size_t k = 0; k < routes.size(); ++k) {
        toSend[k].reserve(routes[k].own.size());
        for (const std::uint32_t p : routes[k].own) toSend[k].push_back(itemOf(p));
        received[k].resize(counts[k]);
        if (!toSend[k].empty()) sends.push_back({routes[k].rank, std::as_bytes(std::span(toSend[k]))});
        if (!received[k].empty()) receives.push_back({routes[k].rank, std::as_writable_bytes(std::span(received[k]))});
    }
    ranks.swap(sends, receives);
    return received;
}

/// Brings what the own particles have, and what other ranks have of the ghosts, into combined order.
/// @param own    one item of each own particle; items are copied as bytes
/// @param combined  receives one item of each own particle and ghost
template <class Item>
void share(const Ranks& ranks, const Halo& halo, const std::vector<Item>& own, std::vector<Item>& combined) {
    const auto received = swapItems<Item>(
        ranks, halo.routes, [&](std::uint32_t p) { return own[p]; }, ghostCounts(halo));
    combined.resize(halo.ids.size());
    for (std::size_t p = 0; p < halo.combinedIndexOf.size(); ++p) combined[halo.combinedIndexOf[p]] = own[p];
    for (std::size_t k = 0; k < halo.routes.size(); ++k)
        for (std::size_t g = 0; g < received[k].size(); ++g) combined[halo.routes[k].ghosts[g]] = received[k][g];
}

}  // namespace engine
