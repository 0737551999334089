// Packs the particles in the order of the neighbor list, in double or in single precision.
#include "engine/forces/packed_particles.h"

#include "engine/core/parallel.h"

namespace engine {

void packDoubles(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities,
                 std::vector<PackedParticle>& packed) {
    packed.resize(list.count());
    inParallel(packed.size(), kParticleGrain, [&](std::size_t k) {
        const std::size_t p = list.order[k];
        const Vec3& x = particles.position[p];
        const Vec3& v = velocities[p];
        packed[k] = {x.x(),          x.y(), x.z(), v.x(), v.y(), v.z(), particles.radius[p], particles.material[p],
                     particles.id[p]};
    });
}

void packFloats(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities, double unit,
                PackedFloats& packed) {
    packed.particles.resize(list.count());
    packed.source = &particles;
    packed.order = &list.order;
    const double perMeter = 1.0 / unit;
    inParallel(list.count(), kParticleGrain, [&](std::size_t k) {
        const std::size_t p = list.order[k];
        const Vec3 units = particles.position[p] * perMeter;
        const Eigen::Vector3f v = velocities[p].cast<float>();
        packed.particles[k] = {toFixedPoint(units.x()),
                               toFixedPoint(units.y()),
                               toFixedPoint(units.z()),
                               static_cast<float>(particles.radius[p]),
                               v.x(),
                               v.y(),
                               v.z(),
                               particles.material[p]};
    });
}

}  // namespace engine
