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

/// Distance of the layers of a face-centered cubic lattice along an axis, half the edge of its cube, m.
double layerDistance(double spacing) {
    return spacing / std::sqrt(2.0);
}

/// Number of layers of a lattice, one of which is in the middle, that fit into a distance (m) of twice `halfExtent`.
double layersWithin(double halfExtent, double spacing) {
    return 2.0 * std::floor(halfExtent / layerDistance(spacing) + kFaceSlack) + 1.0;
}

/// Calls visit(position) for the points of a face-centered cubic lattice with the given number of layers along each
/// axis. A lattice of cube edge a = sqrt(2) spacing has a point wherever the sum of its half-edge coordinates is even.
template <class Visit>
void forEachLatticePoint(const Vec3& center, const Vec3& layers, double spacing, const Visit& visit) {
    const double halfEdge = layerDistance(spacing);
    const Vec3 middle = 0.5 * (layers - Vec3::Ones());
    const std::array<int, 3> counts = {static_cast<int>(layers.x()), static_cast<int>(layers.y()),
                                       static_cast<int>(layers.z())};
    const auto [nx, ny, nz] = counts;
    const int parity = ((nx - 1) / 2 + (ny - 1) / 2 + (nz - 1) / 2) % 2;
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                if ((x + y + z) % 2 == parity) visit(Vec3(center + halfEdge * (Vec3(x, y, z) - middle)));
}

}  // namespace

Vec3 boxLayers(const Vec3& minimum, const Vec3& maximum, const Packing& packing) {
    Vec3 layers;
    for (int axis = 0; axis < 3; ++axis) {
        const double coarse = layersWithin(0.5 * (maximum[axis] - minimum[axis]), packing.refinement * packing.spacing);
        layers[axis] = std::max(1.0, std::round(packing.refinement * coarse));
    }
    return layers;
}

std::vector<Vec3> ballPositions(const Vec3& center, double radius, const Packing& packing) {
    const Vec3 layers = Vec3::Constant(layersWithin(radius, packing.spacing));
    std::vector<Vec3> positions;
    forEachLatticePoint(center, layers, packing.spacing, [&](const Vec3& point) {
        if (squaredLength(point - center) > radius * radius * (1.0 + kFaceSlack)) return;
        positions.push_back(point + jitterOf(packing, positions.size()));
    });
    return positions;
}

std::vector<Vec3> boxPositions(const Vec3& minimum, const Vec3& maximum, const Packing& packing) {
    std::vector<Vec3> positions;
    forEachLatticePoint(0.5 * (minimum + maximum), boxLayers(minimum, maximum, packing), packing.spacing,
                        [&](const Vec3& point) { positions.push_back(point + jitterOf(packing, positions.size())); });
    return positions;
}

// The lattice is cut into blocks, of which those that are far from the shape are left out as a whole.
std::vector<Vec3> positionsInside(const BoundingBox& bounds, const std::function<double(const Vec3&)>& distance,
                                  const Packing& packing, std::size_t most) {
    constexpr int kBlock = 8;  // layers along the edge of a block; chosen: as many as a brick of distances has voxels
    const double halfEdge = layerDistance(packing.spacing);
    const double blockRadius = 0.5 * std::sqrt(3.0) * kBlock * halfEdge;
    const double slack = kFaceSlack * packing.spacing;
    const Vec3 middle = bounds.middle();
    std::array<int, 3> reach{};  // layers to either side of the middle
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double halfExtent = 0.5 * (bounds.high - bounds.low)[static_cast<int>(axis)];
        reach[axis] = static_cast<int>(std::floor(halfExtent / halfEdge + kFaceSlack));
    }
    std::vector<Vec3> positions;
    const auto visitBlock = [&](int x0, int y0, int z0) {
        const Vec3 blockMiddle = middle + halfEdge * (Vec3(x0, y0, z0) + Vec3::Constant(0.5 * (kBlock - 1)));
        if (positions.size() >= most || distance(blockMiddle) > blockRadius) return;
        for (int z = z0; z < std::min(z0 + kBlock, reach[2] + 1); ++z)
            for (int y = y0; y < std::min(y0 + kBlock, reach[1] + 1); ++y)
                for (int x = x0; x < std::min(x0 + kBlock, reach[0] + 1); ++x) {
                    if ((x + y + z) % 2 != 0) continue;
                    const Vec3 point = middle + halfEdge * Vec3(x, y, z);
                    if (distance(point) <= slack) positions.push_back(point + jitterOf(packing, positions.size()));
                }
    };
    for (int z = -reach[2]; z <= reach[2]; z += kBlock)
        for (int y = -reach[1]; y <= reach[1]; y += kBlock)
            for (int x = -reach[0]; x <= reach[0]; x += kBlock) visitBlock(x, y, z);
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
