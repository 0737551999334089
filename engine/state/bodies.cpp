// Fills shapes with lattices of positions. The random displacement of a position is a function of seed and index, so
// that a body is the same on every machine.
#include "engine/state/bodies.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"

namespace engine {
namespace {

/// Relative tolerance with which lattice points exactly on the surface of a body count as inside.
constexpr double kFaceSlack = 1e-9;

Vec3 jitterOf(const Packing& packing, std::uint64_t index) {
    if (packing.jitter == 0.0) return Vec3::Zero();
    return packing.jitter * packing.spacing * randomVector(packing.seed, index);
}

/// Calls visit(position) for the points of a face-centered cubic lattice in a box of the given center and half extent
/// (m). A lattice of cube edge a = sqrt(2) spacing has a point wherever the sum of its half-edge coordinates is even.
template <class Visit>
void forEachLatticePoint(const Vec3& center, const Vec3& halfExtent, double spacing, const Visit& visit) {
    const double halfEdge = spacing / std::sqrt(2.0);
    std::array<int, 3> count{};
    for (int axis = 0; axis < 3; ++axis)
        count[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(halfExtent[axis] / halfEdge + kFaceSlack));
    for (int z = -count[2]; z <= count[2]; ++z)
        for (int y = -count[1]; y <= count[1]; ++y)
            for (int x = -count[0]; x <= count[0]; ++x)
                if ((x + y + z) % 2 == 0) visit(Vec3(center + halfEdge * Vec3(x, y, z)));
}

}  // namespace

std::vector<Vec3> ballPositions(const Vec3& center, double radius, const Packing& packing) {
    std::vector<Vec3> positions;
    forEachLatticePoint(center, Vec3::Constant(radius), packing.spacing, [&](const Vec3& point) {
        if (squaredLength(point - center) > radius * radius * (1.0 + kFaceSlack)) return;
        positions.push_back(point + jitterOf(packing, positions.size()));
    });
    return positions;
}

std::vector<Vec3> boxPositions(const Vec3& minimum, const Vec3& maximum, const Packing& packing) {
    std::vector<Vec3> positions;
    forEachLatticePoint(0.5 * (minimum + maximum), 0.5 * (maximum - minimum), packing.spacing,
                        [&](const Vec3& point) { positions.push_back(point + jitterOf(packing, positions.size())); });
    return positions;
}

std::vector<Vec3> gridPositions(const Vec3& center, const std::array<std::uint32_t, 3>& counts,
                                const Packing& packing) {
    std::vector<Vec3> positions;
    const Vec3 layers(counts[0], counts[1], counts[2]);
    for (std::uint32_t z = 0; z < counts[2]; ++z)
        for (std::uint32_t y = 0; y < counts[1]; ++y)
            for (std::uint32_t x = 0; x < counts[0]; ++x) {
                Vec3 offset = packing.spacing * (Vec3(x, y, z) - 0.5 * (layers - Vec3::Ones()));
                const Vec3 jitter = jitterOf(packing, positions.size());
                for (int axis = 0; axis < 3; ++axis)
                    if (counts[static_cast<std::size_t>(axis)] > 1) offset[axis] += jitter[axis];
                positions.push_back(center + offset);
            }
    return positions;
}

}  // namespace engine
