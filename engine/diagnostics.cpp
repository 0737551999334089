// Sums over particles, in order of birth.
#include "engine/diagnostics.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace engine {
namespace {

class Fnv1a {
 public:
    void add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) {
            hash_ = (hash_ ^ ((word >> (8 * byte)) & 0xFF)) * 0x100000001B3ULL;
        }
    }
    void add(const Vec3& vector) {
        for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(vector[axis]));
    }
    std::string text() const {
        std::string digits(16, '0');
        for (std::size_t d = 0; d < 16; ++d) digits[d] = "0123456789abcdef"[(hash_ >> (60 - 4 * d)) & 0xF];
        return digits;
    }

 private:
    std::uint64_t hash_ = 0xCBF29CE484222325ULL;
};

}  // namespace

Energy energy(ForceEvaluator& evaluator, const Particles& particles) {
    const ForceLaw& law = evaluator.law();
    Energy sum;
    sum.pairs = evaluator.pairEnergyGrid(particles);
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const Vec3& x = particles.position[p];
        const Vec3& v = particles.velocity[p];
        sum.kinetic += 0.5 * particles.mass[p] * squaredLength(v);
        sum.gravity -= particles.mass[p] * dot(law.gravity, x);
        sum.contacts += contactEnergy(law.scenery, {x, v, particles.radius[p], 1.0});
    }
    return sum;
}

Vec3 linearMomentum(const Particles& particles) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < particles.count(); ++p) sum += particles.mass[p] * particles.velocity[p];
    return sum;
}

Vec3 angularMomentum(const Particles& particles) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < particles.count(); ++p)
        sum += particles.mass[p] * particles.position[p].cross(particles.velocity[p]);
    return sum;
}

double largestSpeed(const Particles& particles) {
    double largestSq = 0.0;
    for (const Vec3& velocity : particles.velocity) largestSq = std::max(largestSq, squaredLength(velocity));
    return std::sqrt(largestSq);
}

std::string stateHash(const Particles& particles) {
    Fnv1a hash;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        hash.add(particles.id[p]);
        hash.add(particles.position[p]);
        hash.add(particles.velocity[p]);
    }
    return hash.text();
}

}  // namespace engine
