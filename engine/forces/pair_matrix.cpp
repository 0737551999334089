// Rows filled from the front, products group by group.
#include "engine/forces/pair_matrix.h"

#include <algorithm>

#include "engine/core/parallel.h"

namespace engine {

void PairMatrix::add(std::size_t seat, std::uint32_t other, double alongOf, double acrossOf) {
    const std::size_t part = LaneRows::partOf(seat);
    const std::size_t at = rows.at(seat, rows.length[seat]++);
    rows.parts[part].setPlace(at, other);
    along[part][at] = alongOf;
    if (!across.empty()) across[part][at] = acrossOf;
}

void makeRoom(PairMatrix& matrix, const NeighborList& list, bool hasFriction) {
    const std::size_t parts = list.rows.parts.size();
    matrix.rows.selves = list.rows.selves;
    matrix.rows.length.assign(list.rows.length.size(), 0);
    matrix.rows.parts.resize(parts);
    matrix.along.resize(parts);
    matrix.across.resize(hasFriction ? parts : 0);
    inParallel(parts, 1, [&](std::size_t part) {
        const RowPart& like = list.rows.parts[part];
        RowPart& rows = matrix.rows.parts[part];
        rows.start = like.start;
        rows.base = like.base;
        rows.narrow.resize(like.narrow.size());
        rows.wide.resize(like.wide.size());
        const std::size_t room = std::max(like.narrow.size(), like.wide.size());
        matrix.along[part].resize(room);
        if (hasFriction) matrix.across[part].resize(room);
    });
}

void close(PairMatrix& matrix) {
    inParallel(matrix.rows.groupCount(), 16, [&](std::size_t group) {
        const std::size_t end = (group + 1) * kGroup;
        const std::size_t part = LaneRows::partOf(group * kGroup);
        std::uint32_t longest = 0;
        for (std::size_t seat = group * kGroup; seat < end; ++seat)
            longest = std::max(longest, matrix.rows.length[seat]);
        for (std::size_t seat = group * kGroup; seat < end; ++seat) {
            for (std::uint32_t k = matrix.rows.length[seat]; k < longest; ++k) {
                const std::size_t at = matrix.rows.at(seat, k);
                matrix.rows.parts[part].setPlace(at, static_cast<std::uint32_t>(matrix.rows.selves[seat]));
                matrix.along[part][at] = 0.0;
                if (!matrix.across.empty()) matrix.across[part][at] = 0.0;
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
        for (std::size_t seat = first; seat < end; ++seat) {
            const std::size_t lane = seat - first;
            const auto place = static_cast<std::size_t>(matrix.rows.selves[seat]);
            product[place] = matrix.mass[place] * x[place] + Vec3(of.x[lane], of.y[lane], of.z[lane]);
            if (!matrix.own.empty()) product[place] += matrix.own[place] * x[place];
        }
    });
}

}  // namespace engine
