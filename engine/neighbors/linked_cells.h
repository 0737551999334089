// Finding particles near a point while more of them are added: every cell is a linked list of its particles, found by a
// hash of its numbers. Used at the few moments at which particles are emitted, when CellGrid, which is sorted once and
// for all, would have to be built anew for each; neighbor lists come from CellGrid.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Memory is linear in the number of particles, and no box has to bound the world.
class LinkedCells {
 public:
    /// Cells without a width: they never find a particle.
    LinkedCells() = default;

    /// Cells with particles 0, 1, ... at these positions (m, finite).
    /// @param width  of the cells, in meters, above 0
    LinkedCells(double width, const std::vector<Vec3>& positions);

    /// Adds the next particle.
    void add(const Vec3& position);

    /// Calls visit(particle) once for each particle within a cell width of a point (m), and for some further away, in
    /// an order that depends on the positions alone.
    template <class Visit>
    void forEachNear(const Vec3& point, const Visit& visit) const {
        if (links_.empty()) return;
        const Cell home = cellOf(point);
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
        std::uint64_t key = 0;  ///< of the particle's cell; a chain may hold other cells, too
        std::uint32_t next = kEnd;
    };

    Cell cellOf(const Vec3& position) const;
    static std::uint64_t keyOf(const Cell& cell);
    std::size_t chainOf(std::uint64_t key) const;
    void link(std::size_t p);

    double width_ = 0.0;
    std::vector<std::uint32_t>
        first_;                ///< first particle of each chain; as many chains as particles or more, a power of two
    std::vector<Link> links_;  ///< one for each particle
};

}  // namespace engine
