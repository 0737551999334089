// Who is near a sortedIndex, where particles are added one at a time: every cell is a chain through those in it. For
// the few moments at which particles are born; lists of neighbors come from the sorted CellGrid.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Chains of particles, found by a hash of their cell: memory is linear in n, and no box has to bound the world.
class LinkedCells {
 public:
    /// Nobody is ever near.
    LinkedCells() = default;

    /// Of particles 0, 1, ... at finite positions, m. Shape: cells of a width above 0, m.
    LinkedCells(double width, const std::vector<Vec3>& positions);

    /// Adds the next particle.
    void add(const Vec3& position);

    /// Calls visit(particle) once for each particle within a width of the sortedIndex, and for others; in an order that
    /// depends on the positions alone.
    template <class Visit>
    void forEachNear(const Vec3& sortedIndex, const Visit& visit) const {
        if (links_.empty()) return;
        const Cell home = cellOf(sortedIndex);
        for (std::int64_t z = home.z - 1; z <= home.z + 1; ++z)
            for (std::int64_t y = home.y - 1; y <= home.y + 1; ++y)
                for (std::int64_t x = home.x - 1; x <= home.x + 1; ++x) {
                    const std::uint64_t key = keyOf({x, y, z});
                    for (std::uint32_t p = first_[chainOf(key)]; p != kEnd; p = links_[p].next)
                        if (links_[p].key == key) visit(p);
                }
    }

 private:
    static constexpr std::uint32_t kEnd = 0xffffffff;

    struct Cell {
        std::int64_t x = 0;
        std::int64_t y = 0;
        std::int64_t z = 0;
    };

    struct Link {
        std::uint64_t key = 0;  ///< of its cell: other cells of a chain are passed over
        std::uint32_t next = kEnd;
    };

    Cell cellOf(const Vec3& position) const;
    static std::uint64_t keyOf(const Cell& cell);
    std::size_t chainOf(std::uint64_t key) const;
    void link(std::size_t p);

    double width_ = 0.0;
    std::vector<std::uint32_t> first_;  ///< of each chain; a power of two of them, no fewer than there are particles
    std::vector<Link> links_;           ///< of each particle
};

}  // namespace engine
