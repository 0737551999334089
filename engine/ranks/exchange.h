// Exchange of items whose numbers only the sender knows.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/ranks/ranks.h"

namespace engine {

/// Sends items to ranks, and returns those received, in the order of the ranks that have sent them.
/// @param toRanks  the items for each rank; may be copied as bytes
template <class Item>
std::vector<Item> exchangeItems(const Ranks& ranks, const std::vector<std::vector<Item>>& toRanks) {
    std::vector<std::int64_t> counts;
    for (const std::vector<Item>& items : toRanks) counts.push_back(static_cast<std::int64_t>(items.size()));
    counts = ranks.swapNumbers(counts);
    std::size_t total = 0;
    for (const std::int64_t count : counts) total += static_cast<std::size_t>(count);
    std::vector<Item> received(total);
    std::vector<Message<const std::byte>> sends;
    std::vector<Message<std::byte>> receives;
    std::size_t begin = 0;
    for (std::size_t rank = 0; rank < toRanks.size(); ++rank) {
        const std::span<Item> room = std::span(received).subspan(begin, static_cast<std::size_t>(counts[rank]));
        begin += room.size();
        if (static_cast<int>(rank) == ranks.own()) {
            std::copy(toRanks[rank].begin(), toRanks[rank].end(), room.begin());
            continue;
        }
        if (!toRanks[rank].empty()) sends.push_back({static_cast<int>(rank), std::as_bytes(std::span(toRanks[rank]))});
        if (!room.empty()) receives.push_back({static_cast<int>(rank), std::as_writable_bytes(room)});
    }
    ranks.swap(sends, receives);
    return received;
}

}  // namespace engine
