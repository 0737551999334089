// Rows filled from the front, products group by group.
#include "engine/pair_matrix.h"

#include <algorithm>

#include "engine/lane_product.h"
#include "engine/parallel.h"

namespace engine {

void PairMatrix::add(std::size_t place, std::int32_t other, double alongOf, double acrossOf) {
    const std::size_t at = rows.at(place, rows.length[place]++);
    rows.places[at] = other;
    along[at] = alongOf;
    if (!across.empty()) across[at] = acrossOf;
}

void makeRoom(PairMatrix& matrix, const NeighbourList& list, bool hasFriction) {
    matrix.rows.start = list.rows.start;
    matrix.rows.length.assign(list.rows.length.size(), 0);
    matrix.rows.places.resize(list.rows.places.size());
    matrix.along.resize(matrix.rows.places.size());
    matrix.across.resize(hasFriction ? matrix.rows.places.size() : 0);
}

void close(PairMatrix& matrix) {
    inParallel(matrix.rows.groupCount(), 16, [&](std::size_t group) {
        const std::size_t end = (group + 1) * kGroup;
        std::uint32_t longest = 0;
        for (std::size_t place = group * kGroup; place < end; ++place)
            longest = std::max(longest, matrix.rows.length[place]);
        for (std::size_t place = group * kGroup; place < end; ++place) {
            const auto self = static_cast<std::int32_t>(std::min(place, matrix.records.size() - 1));
            for (std::uint32_t k = matrix.rows.length[place]; k < longest; ++k) {
                const std::size_t at = matrix.rows.at(place, k);
                matrix.rows.places[at] = self;
                matrix.along[at] = 0.0;
                if (!matrix.across.empty()) matrix.across[at] = 0.0;
            }
        }
    });
}

void multiply(PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product) {
    product.resize(matrix.count());
    inParallel(matrix.count(), kParticleGrain, [&](std::size_t place) {
        PairRecord& record = matrix.records[place];
        record.vx = x[place].x();
        record.vy = x[place].y();
        record.vz = x[place].z();
    });
    constexpr std::size_t kGrain = 4;  // chosen: rows of a dense scene take a tenth of a microsecond each
    inParallel(matrix.rows.groupCount(), kGrain, [&](std::size_t group) {
        LaneProduct of;
        multiplyGroup(matrix, group, of);
        const std::size_t first = group * kGroup;
        const std::size_t end = std::min(first + kGroup, matrix.count());
        for (std::size_t place = first; place < end; ++place) {
            const std::size_t lane = place - first;
            product[place] = matrix.mass[place] * x[place] + Vec3(of.x[lane], of.y[lane], of.z[lane]);
            if (!matrix.own.empty()) product[place] += matrix.own[place] * x[place];
        }
    });
}

}  // namespace engine
