// Finds particles near a point while more particles are added. Every cell is a linked list of its particles, found by a
// hash of the cell's numbers along the axes. Used when particles are emitted, where a CellGrid would have to be built
// anew for each new particle. Neighbor lists are built from a CellGrid.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Particles in linked cells. Memory is linear in the number of particles, and the world need not be bounded.
class LinkedCells {
 public:
    /// Makes cells that store no particles and never find any.
    LinkedCells() = default;

    /// Makes cells with particles 0, 1, ... at these positions (m), which must be finite.
    /// @param width  width of the cells, in meters, above 0
    LinkedCells(double width, const std::vector<Vec3>& positions);

    /// Adds a particle at a position (m). Its index is the number of particles added before.
    void add(const Vec3& position);

    /// Calls visit(particle index) once for each particle within a cell width of a point (m), and for some particles
    /// further away. The order depends only on the positions.
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
        std::uint64_t key = 0;  ///< key of the particle's cell; a chain may mix cells
        std::uint32_t next = kEnd;
    };

    Cell cellOf(const Vec3& position) const;
    static std::uint64_t keyOf(const Cell& cell);
    std::size_t chainOf(std::uint64_t key) const;
    void link(std::size_t p);

    double width_ = 0.0;
    std::vector<std::uint32_t> first_;  ///< first particle of each hash chain; their number is a power of two
    std::vector<Link> links_;           ///< link of each particle
};

}  // namespace engine
