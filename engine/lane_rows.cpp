// Two passes: how long, then what.
#include "engine/lane_rows.h"

#include <algorithm>

#include "engine/parallel.h"

namespace engine {

void makeRoom(LaneRows& rows, const NeighbourList& list) {
    const std::size_t count = list.count();
    const std::size_t groups = (count + kGroup - 1) / kGroup;
    rows.length.assign(groups * kGroup, 0);
    rows.start.assign(groups + 1, 0);
    for (std::size_t place = 0; place < count; ++place) {
        std::uint32_t& longest = rows.start[place / kGroup + 1];
        longest = std::max(longest, list.rowStart[place + 1] - list.rowStart[place]);
    }
    for (std::size_t group = 0; group < groups; ++group) rows.start[group + 1] += rows.start[group];
    // One more than there are: kernels step past the end of a row before they see that it is the last, or empty.
    rows.places.resize((rows.start[groups] + 1) * kGroup);
}

void build(LaneRows& rows, const NeighbourList& list) {
    makeRoom(rows, list);
    const std::size_t count = list.count();
    for (std::size_t place = 0; place < count; ++place)
        rows.length[place] = list.rowStart[place + 1] - list.rowStart[place];
    inParallel(rows.groupCount(), 16, [&](std::size_t group) {
        for (std::size_t place = group * kGroup; place < (group + 1) * kGroup; ++place) {
            const auto self = static_cast<std::int32_t>(std::min(place, count - 1));
            const std::size_t first = rows.at(place, 0);
            const std::size_t longest = rows.start[group + 1] - rows.start[group];
            const std::uint32_t* from = rows.length[place] > 0 ? &list.places[list.rowStart[place]] : nullptr;
            for (std::size_t k = 0; k < longest; ++k)
                rows.places[first + k * kGroup] = k < rows.length[place] ? static_cast<std::int32_t>(from[k]) : self;
        }
    });
}

}  // namespace engine
