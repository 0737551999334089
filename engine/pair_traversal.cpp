// Sorting for a visit.
#include "engine/pair_traversal.h"

namespace engine {

PairTraversal::PairTraversal(const ForceLaw& law)
    : pairMaterials(mixedPairs(law.materials)), materialCount(law.materials.size()) {}

void PairTraversal::prepare(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities) {
    terms = termsFor(law, particles);
    if (terms.uniform && particles.count() > 0)
        uniform = pairConstants<double>(pairMaterials.front(), 2.0 * particles.radius.front());
    build(grid, particles.position, terms.cutoff);
    records.resize(particles.count());
    for (std::size_t slot = 0; slot < records.size(); ++slot) {
        const std::size_t p = grid.order[slot];
        const Vec3& x = particles.position[p];
        const Vec3& v = velocities[p];
        records[slot] = {x.x(),          x.y(), x.z(), v.x(), v.y(), v.z(), particles.radius[p], particles.material[p],
                         particles.id[p]};
    }
}

}  // namespace engine
