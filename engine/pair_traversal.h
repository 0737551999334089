// One way over all neighbouring pairs for everything that sums over them: forces, energies, the step bound. Each
// particle visits its own neighbours in a fixed order and writes to itself alone: no thread waits for another, and no
// sum depends on how the work is shared out.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <vector>

#include "engine/force_law.h"
#include "engine/neighbours.h"
#include "engine/pair_law.h"

namespace engine {

/// A particle as the kernels read it, in cell order; one cache line.
struct alignas(64) PairRecord {
    double x, y, z;
    double vx, vy, vz;
    double radius;
    std::uint32_t material;
    std::uint32_t id;
};

/// Particles sorted for visiting, and the constants of their pairs. Kept between visits for its memory.
struct PairTraversal {
    std::vector<Material> pairMaterials;  ///< mixedPairs of the law
    std::size_t materialCount = 0;
    ForceTerms terms;
    PairConstants<double> uniform;  ///< of every pair, where the terms are uniform
    CellGrid grid;
    std::vector<PairRecord> records;  ///< in the grid's order

    PairTraversal() = default;
    explicit PairTraversal(const ForceLaw& law);

    /// Sorts the particles, with the velocities (m/s) that the damping is to see.
    void prepare(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities);

    template <bool isUniform>
    PairConstants<double> constants(const PairRecord& p, const PairRecord& i) const {
        if constexpr (isUniform) return uniform;
        return pairConstants<double>(pairMaterials[p.material * materialCount + i.material], p.radius + i.radius);
    }

    /// Calls visit(other, P, P.P) for every other particle within the cutoff of the one at a place in the grid's order.
    /// Most candidates of a cell are out of reach, unpredictably so: they are sifted without branches first.
    template <class Visit>
    void forEachNeighbour(const Neighbourhood& around, std::uint32_t self, const Visit& visit) const {
        const PairRecord& p = records[self];
        const double cutoffSq = terms.cutoff * terms.cutoff;
        std::array<std::uint32_t, kSieve> within;
        for (int r = 0; r < around.count; ++r) {
            const CellRange range = around.ranges[static_cast<std::size_t>(r)];
            for (std::uint32_t begin = range.begin; begin < range.end; begin += kSieve) {
                const std::uint32_t end = std::min(begin + kSieve, range.end);
                std::size_t found = 0;
                for (std::uint32_t other = begin; other < end; ++other) {
                    within[found] = other;
                    found += squaredLength(separationOf(p, records[other])) < cutoffSq ? 1U : 0U;
                }
                for (std::size_t k = 0; k < found; ++k)
                    if (within[k] != self) visitOne(p, records[within[k]], visit);
            }
        }
    }

    /// Calls body(neighbourhood, place in the grid's order) for every particle, cells shared out over the threads.
    template <class Body>
    void forEachParticle(const Body& body) const {
        constexpr std::size_t kGrain = 16;  // chosen: cells of a dense scene take some microseconds each
        // Isolated, so that a waiting thread does not take up a whole frame's drawing meanwhile.
        tbb::this_task_arena::isolate([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.cellCount(), kGrain), [&](const auto& cells) {
                for (std::size_t cell = cells.begin(); cell < cells.end(); ++cell) {
                    if (grid.start[cell] == grid.start[cell + 1]) continue;
                    const Neighbourhood around = neighbourhood(grid, static_cast<std::uint32_t>(cell));
                    for (std::uint32_t self = grid.start[cell]; self < grid.start[cell + 1]; ++self) body(around, self);
                }
            });
        });
    }

 private:
    static constexpr std::uint32_t kSieve = 256;  // chosen: a kilobyte on the stack, longer than most rows of cells

    static Vec3 separationOf(const PairRecord& p, const PairRecord& i) { return {p.x - i.x, p.y - i.y, p.z - i.z}; }

    template <class Visit>
    static void visitOne(const PairRecord& p, const PairRecord& i, const Visit& visit) {
        Vec3 separation = separationOf(p, i);
        double distanceSq = squaredLength(separation);
        if (distanceSq == 0.0) {
            const auto [x, y, z] = coincidentSeparation(p.id, i.id, p.radius + i.radius);
            separation = Vec3(x, y, z);
            distanceSq = squaredLength(separation);
        }
        visit(i, separation, distanceSq);
    }
};

}  // namespace engine
