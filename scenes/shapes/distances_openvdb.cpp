// Signed distances from meshes by OpenVDB: the module that mesh_distances.cpp loads. The only file of its room that
// includes OpenVDB.
#include <openvdb/version.h>
// What is used of OpenVDB is compiled here, with the project's own flags: instances in the system's library may be
// compiled with fused multiplications, which give other bits.
#undef OPENVDB_USE_EXPLICIT_INSTANTIATION
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <limits>
#include <set>

#include "scenes/shapes/distances_module.h"
#include "scenes/shapes/mesh_distances.h"

namespace scenes {
namespace {

using openvdb::Coord;

static_assert(openvdb::FloatTree::LeafNodeType::DIM == engine::kBrickVoxels);

/// The first nodes of all bricks that may have a value below the band, in the order in which bricks are numbered.
std::vector<Coord> candidates(const openvdb::FloatTree& tree, float band) {
    constexpr int kDim = engine::kBrickVoxels;
    std::set<std::array<int, 3>> found;  // z, y, x
    const auto addWithNeighbors = [&](const Coord& first) {
        // The first nodes of a brick are the last ones of those before it.
        for (int z = 0; z < 2; ++z)
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 2; ++x)
                    found.insert({first.z() - kDim * z, first.y() - kDim * y, first.x() - kDim * x});
    };
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) addWithNeighbors(leaf->origin());
    // Larger parts of the inside may be single values.
    for (auto tile = tree.cbeginValueAll(); tile; ++tile) {
        if (tile.isVoxelValue() || !(*tile < band)) continue;
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        for (int z = box.min().z(); z <= box.max().z(); z += kDim)
            for (int y = box.min().y(); y <= box.max().y(); y += kDim)
                for (int x = box.min().x(); x <= box.max().x(); x += kDim) addWithNeighbors({x, y, z});
    }
    std::vector<Coord> bricks;
    for (const auto& [z, y, x] : found) bricks.emplace_back(x, y, z);
    return bricks;
}

/// The values of a brick, at most the band; nothing if all are the band.
bool readBrick(openvdb::FloatGrid::ConstAccessor& grid, const Coord& first, float band, std::vector<float>& values) {
    values.clear();
    for (int z = 0; z < engine::kBrickNodes; ++z)
        for (int y = 0; y < engine::kBrickNodes; ++y)
            for (int x = 0; x < engine::kBrickNodes; ++x)
                values.push_back(std::min(grid.getValue(first.offsetBy(x, y, z)), band));
    return std::ranges::any_of(values, [&](float value) { return value < band; });
}

engine::DistanceBricks bricksOf(const openvdb::FloatGrid& grid, double voxel) {
    const float band = grid.background();
    constexpr int kDim = engine::kBrickVoxels;
    struct Brick {
        Coord first;
        std::vector<float> values;
    };
    std::vector<Brick> bricks;
    auto accessor = grid.getConstAccessor();
    std::vector<float> values;
    Coord low = Coord::max();
    Coord high = Coord::min();
    for (const Coord& first : candidates(grid.tree(), band)) {
        if (!readBrick(accessor, first, band, values)) continue;
        bricks.push_back({first, values});
        low.minComponent(first);
        high.maxComponent(first);
    }
    engine::DistanceBricks result;
    result.voxel = voxel;
    result.band = band;
    if (bricks.empty()) return result;
    result.origin = {voxel * low.x(), voxel * low.y(), voxel * low.z()};
    const Coord size = (high - low).offsetBy(kDim);
    result.counts = {static_cast<std::uint32_t>(size.x() / kDim), static_cast<std::uint32_t>(size.y() / kDim),
                     static_cast<std::uint32_t>(size.z() / kDim)};
    result.brickOf.assign(std::size_t{result.counts[0]} * result.counts[1] * result.counts[2],
                          engine::DistanceBricks::kNone);
    for (std::size_t k = 0; k < bricks.size(); ++k) {
        const Coord place = (bricks[k].first - low) >> 3;
        const auto row = static_cast<std::size_t>(place.z()) * result.counts[1] + static_cast<std::size_t>(place.y());
        result.brickOf[row * result.counts[0] + static_cast<std::size_t>(place.x())] = static_cast<std::uint32_t>(k);
        result.values.insert(result.values.end(), bricks[k].values.begin(), bricks[k].values.end());
    }
    return result;
}

engine::DistanceBricks bricksOfMesh(const Mesh& mesh, const VoxelGrid& wanted) {
    const double voxel = wanted.voxel;
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;  // in voxels
    std::vector<openvdb::Vec3I> triangles;
    for (const engine::Vec3& point : mesh.points) {
        const engine::Vec3 scaled = point / voxel;
        points.emplace_back(static_cast<float>(scaled.x()), static_cast<float>(scaled.y()),
                            static_cast<float>(scaled.z()));
    }
    for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points, triangles);
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    // An unlimited band fills the inside.
    const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
        adapter, *transform, static_cast<float>(wanted.band / voxel), std::numeric_limits<float>::max());
    return bricksOf(*grid, voxel);
}

}  // namespace
}  // namespace scenes

const scenes::DistancesModule globularDistances = {scenes::bricksOfMesh};
