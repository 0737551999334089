// One row a particle, each written by one thread.
#include "engine/pair_matrix.h"

#include "engine/parallel.h"

namespace engine {

void multiply(const PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product) {
    product.resize(matrix.count());
    const bool hasFriction = !matrix.across.empty();
    constexpr std::size_t kGrain = 256;  // chosen: rows of a dense scene take a tenth of a microsecond each
    inParallel(matrix.count(), kGrain, [&](std::size_t p) {
        const Vec3 own = x[p];
        Vec3 sum = matrix.mass[p] * own;
        if (!matrix.own.empty()) sum += matrix.own[p] * own;
        for (std::uint32_t entry = matrix.rowStart[p]; entry < matrix.rowEnd[p]; ++entry) {
            const Vec3& q = matrix.along[entry];
            const Vec3 difference = own - x[matrix.other[entry]];
            sum += dot(q, difference) * q;
            if (!hasFriction) continue;
            const Vec3& normal = matrix.normal[entry];
            sum += matrix.across[entry] * (difference - dot(normal, difference) * normal);
        }
        product[p] = sum;
    });
}

}  // namespace engine
