// Meshes and .vdb files by OpenVDB: the module that isosurface.cpp loads. The only file that includes OpenVDB: it takes
// as long to compile as all others of its room together.
#include "render/mesh/openvdb_module.h"

#include <openvdb/version.h>
// What is used of OpenVDB is compiled here, with the project's own flags: instances in the system's library may be
// compiled with fused multiplications, which give other bits.
#undef OPENVDB_USE_EXPLICIT_INSTANTIATION
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace render {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
static_assert(Leaf::DIM == kBlockSide);

/// Half the width of the band of distances around the surface, in voxels: what tools for level sets expect.
constexpr float kHalfWidth = 3.0F;

openvdb::Coord firstNode(const glm::ivec3& block) {
    return openvdb::Coord(block.x, block.y, block.z) << 3;
}

openvdb::FloatGrid::Ptr gridOf(const SampledField& field) {
    auto grid = openvdb::FloatGrid::create(field.outside);
    for (std::size_t k = 0; k < field.blocks.size(); ++k) {
        auto* leaf = new Leaf(firstNode(field.blocks[k]), field.outside, true);
        std::copy(field.values[k]->begin(), field.values[k]->end(), leaf->buffer().data());
        grid->tree().addLeaf(leaf);  // which the tree owns from now on
    }
    for (const glm::ivec3& block : field.inside) grid->tree().addTile(1, firstNode(block), -field.outside, false);
    return grid;
}

/// A file in memory. OpenVDB's own classes write either to a path or without the offsets that most readers need.
class MemoryFile : public openvdb::io::Archive {
 public:
    Ptr copy() const override { return Ptr(new MemoryFile(*this)); }
    std::string bytesOf(const openvdb::GridBase::ConstPtr& grid) const {
        std::ostringstream stream;
        write(stream, openvdb::GridCPtrVec{grid}, true);
        return std::move(stream).str();
    }
};

/// Replaces the random identifier in the header of a .vdb file by one that depends on the other bytes alone.
void makeRepeatable(std::string& file) {
    // A magic number of 8 bytes, three versions of 4 bytes, a flag; then 36 digits and hyphens.
    constexpr std::size_t kStart = 21;
    constexpr std::size_t kLength = 36;
    std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
    for (std::size_t k = kStart + kLength; k < file.size(); ++k)
        hash = (hash ^ static_cast<unsigned char>(file[k])) * 0x100000001b3U;
    for (std::size_t k = kStart; k < kStart + kLength; ++k) {
        if (file[k] == '-') continue;
        file[k] = "0123456789abcdef"[hash % 16];
        hash = hash / 16 + (hash % 16 << 60);
    }
}

QuadMesh meshQuads(const SampledField& field) {
    QuadMesh mesh;
    if (field.blocks.empty()) return mesh;
    const openvdb::FloatGrid::Ptr grid = gridOf(field);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);  // values are negative inside
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, points, quads, 0.0);
    mesh.points.reserve(points.size());
    for (const openvdb::Vec3s& point : points) mesh.points.emplace_back(point.x(), point.y(), point.z());
    mesh.quads.reserve(quads.size());
    // OpenVDB's run clockwise.
    for (const openvdb::Vec4I& quad : quads) mesh.quads.push_back({quad[3], quad[2], quad[1], quad[0]});
    return mesh;
}

/// From voxels to meters.
openvdb::math::Transform::Ptr transformOf(const GridLabel& label) {
    auto transform = openvdb::math::Transform::createLinearTransform(label.cell);
    transform->postTranslate({label.origin.x, label.origin.y, label.origin.z});
    return transform;
}

/// The bytes of a file with one grid, which gets the name and what the label says.
std::string fileOf(const openvdb::FloatGrid::Ptr& grid, const char* name, const GridLabel& label) {
    grid->setName(name);
    grid->insertMeta("time", openvdb::DoubleMetadata(label.time));
    grid->insertMeta("frame", openvdb::Int32Metadata(label.frame));
    grid->insertMeta("scene_hash", openvdb::StringMetadata(label.sceneHash));
    std::string file = MemoryFile().bytesOf(grid);
    makeRepeatable(file);
    return file;
}

std::string encodeDistances(const TriangleMesh& mesh, const GridLabel& label) {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;  // in voxels
    std::vector<openvdb::Vec3I> triangles;
    points.reserve(mesh.positions.size());
    triangles.reserve(mesh.triangles.size());
    for (const glm::dvec3& position : mesh.positions) {
        const glm::vec3 at(position / label.cell);
        points.emplace_back(at.x, at.y, at.z);
    }
    for (const Triangle& triangle : mesh.triangles) triangles.emplace_back(triangle[0], triangle[1], triangle[2]);
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points, triangles);
    const auto grid =
        openvdb::tools::meshToVolume<openvdb::FloatGrid>(adapter, *transformOf(label), kHalfWidth, kHalfWidth);
    return fileOf(grid, "surface", label);
}

std::string encodeDensity(const SampledField& field, float isoValue, const GridLabel& label) {
    openvdb::initialize();
    const openvdb::FloatGrid::Ptr grid = gridOf(field);
    for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf)
        for (auto value = leaf->beginValueOn(); value; ++value)
            if (*value == field.outside) value.setValueOff();
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setTransform(transformOf(label));
    grid->insertMeta("iso_value", openvdb::FloatMetadata(isoValue));
    return fileOf(grid, "density", label);
}

}  // namespace
}  // namespace render

const render::OpenVdbModule globularOpenVdb = {OPENVDB_LIBRARY_VERSION_STRING, render::meshQuads,
                                               render::encodeDistances, render::encodeDensity};
