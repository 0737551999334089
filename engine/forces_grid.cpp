// Equation 1 over the cell grid. Each particle adds up its own forces, cell by cell in a fixed order, and writes to itself
// alone: no thread waits for another, and the sum does not depend on how the work is shared out.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "engine/forces.h"

namespace engine {
namespace {

/// What every particle of one evaluation shares.
struct Shared {
    const PairRecord* records = nullptr;
    const Material* pairs = nullptr;
    std::size_t materialCount = 0;
    PairConstants<double> uniform;      ///< of every pair, where the terms are uniform
    double cutoffSq = 0.0;
};

template <bool uniform>
PairConstants<double> constantsOf(const Shared& shared, const PairRecord& p, const PairRecord& i) {
    if constexpr (uniform) return shared.uniform;
    return pairConstants<double>(shared.pairs[p.material * shared.materialCount + i.material], p.radius + i.radius);
}

/// Calls visit(other, P, P.P) for every other particle of the neighbourhood within the cutoff, in storage order.
template <class Visit>
void forEachNeighbour(const Shared& shared, const Neighbourhood& around, std::uint32_t self, const Visit& visit) {
    const PairRecord& p = shared.records[self];
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        for (std::uint32_t other = range.begin; other < range.end; ++other) {
            const PairRecord& i = shared.records[other];
            Vec3 separation(p.x - i.x, p.y - i.y, p.z - i.z);
            double distanceSq = squaredLength(separation);
            if (distanceSq >= shared.cutoffSq || other == self) continue;
            if (distanceSq == 0.0) {
                const auto [x, y, z] = coincidentSeparation(p.id, i.id, p.radius + i.radius);
                separation = Vec3(x, y, z);
                distanceSq = squaredLength(separation);
            }
            visit(i, separation, distanceSq);
        }
    }
}

template <PairTerms terms, bool uniform>
Vec3 forceOn(const Shared& shared, const Neighbourhood& around, std::uint32_t self) {
    const PairRecord& p = shared.records[self];
    Vec3 force = Vec3::Zero();
    forEachNeighbour(shared, around, self, [&](const PairRecord& i, const Vec3& separation, double distanceSq) {
        double approach = 0.0;
        if constexpr (terms.damping)
            approach = dot(Vec3(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz), separation);
        const auto constants = constantsOf<uniform>(shared, p, i);
        force += pairCoefficient<terms>(distanceSq, approach, constants) * separation;
    });
    return force;
}

/// Half of the energy of every pair of a particle.
double energyOf(const Shared& shared, const Neighbourhood& around, std::uint32_t self) {
    const PairRecord& p = shared.records[self];
    double energy = 0.0;
    forEachNeighbour(shared, around, self, [&](const PairRecord& i, const Vec3&, double distanceSq) {
        energy += 0.5 * pairEnergy(std::sqrt(distanceSq), constantsOf<false>(shared, p, i));
    });
    return energy;
}

/// Runs body(neighbourhood, sorted index) for every particle, cells shared out over the threads.
template <class Body>
void forEachParticle(const CellGrid& grid, const Body& body) {
    constexpr std::size_t kGrain = 16;  // chosen: cells of a dense scene take some microseconds each
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

template <PairTerms terms, bool uniform>
void addUp(const Shared& shared, const CellGrid& grid, std::vector<Vec3>& forces) {
    forEachParticle(grid, [&](const Neighbourhood& around, std::uint32_t self) {
        forces[grid.order[self]] = forceOn<terms, uniform>(shared, around, self);
    });
}

using Kernel = void (*)(const Shared&, const CellGrid&, std::vector<Vec3>&);

template <bool uniform>
Kernel kernelFor(PairTerms terms) {
    if (terms.attraction)
        return terms.damping ? addUp<PairTerms{true, true}, uniform> : addUp<PairTerms{true, false}, uniform>;
    return terms.damping ? addUp<PairTerms{false, true}, uniform> : addUp<PairTerms{false, false}, uniform>;
}

}  // namespace

void ForceEvaluator::sortIntoCells(const Particles& particles, const std::vector<Vec3>& velocities, double cutoff) {
    build(grid_, particles.position, cutoff);
    records_.resize(particles.count());
    for (std::size_t slot = 0; slot < records_.size(); ++slot) {
        const std::size_t p = grid_.order[slot];
        const Vec3& x = particles.position[p];
        const Vec3& v = velocities[p];
        records_[slot] = {x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), particles.radius[p], particles.material[p], particles.id[p]};
    }
}

void ForceEvaluator::pairForcesGrid(const Particles& particles, const std::vector<Vec3>& velocities,
                                    std::vector<Vec3>& forces) {
    forces.assign(particles.count(), Vec3::Zero());
    if (particles.count() < 2) return;
    const ForceTerms terms = termsFor(law_, particles);
    sortIntoCells(particles, velocities, terms.cutoff);
    Shared shared{records_.data(), pairs_.data(), law_.materials.size(), {}, terms.cutoff * terms.cutoff};
    if (terms.uniform) shared.uniform = pairConstants<double>(pairs_.front(), 2.0 * particles.radius.front());
    (terms.uniform ? kernelFor<true>(terms.pair) : kernelFor<false>(terms.pair))(shared, grid_, forces);
}

double ForceEvaluator::pairEnergyGrid(const Particles& particles) {
    if (particles.count() < 2) return 0.0;
    const ForceTerms terms = termsFor(law_, particles);
    sortIntoCells(particles, particles.velocity, terms.cutoff);
    const Shared shared{records_.data(), pairs_.data(), law_.materials.size(), {}, terms.cutoff * terms.cutoff};
    energies_.resize(particles.count());
    forEachParticle(grid_, [&](const Neighbourhood& around, std::uint32_t self) {
        energies_[self] = energyOf(shared, around, self);
    });
    double sum = 0.0;  // serial: the order of the sum is part of the result
    for (const double energy : energies_) sum += energy;
    return sum;
}

}  // namespace engine
