// The .vdb files of meshes, read by OpenVDB's own reader.
#include "tests/catch.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <openvdb/openvdb.h>

#include "render/mesh/isosurface.h"
#include "render/mesh/surface_mesh.h"

namespace {

namespace fs = std::filesystem;

/// The grids of a .vdb file with these bytes.
openvdb::GridPtrVec gridsIn(const std::string& bytes) {
    openvdb::initialize();
    std::string pattern = (fs::temp_directory_path() / "globular-test-XXXXXX").string();
    const fs::path folder = ::mkdtemp(pattern.data());
    const fs::path path = folder / "mesh.vdb";
    std::ofstream(path, std::ios::binary) << bytes;
    openvdb::io::File file(path.string());
    file.open(false);  // read at once, because the file is removed
    REQUIRE(file.hasGrid("surface"));
    const openvdb::GridPtrVec grids = *file.getGrids();
    file.close();
    fs::remove_all(folder);
    return grids;
}

}  // namespace

TEST_CASE("OpenVDB reads a level set as it was written", "[mesh]") {
    const double radius = 0.25;
    const glm::vec3 center(0.5F, 1.25F, -2.0F);
    render::View view;
    view.particles = {{center, static_cast<float>(radius), glm::vec3(0.5F)}};
    const double cell = 0.04;
    const glm::dvec3 origin(1000.0, 0.0, -512.0);
    const auto mesh = render::surfaceMesh(view, std::vector<glm::vec3>(1), cell);
    const openvdb::GridPtrVec grids =
        gridsIn(render::encodeLevelSet(mesh, {cell, origin, 4.0 / 3.0, 40, "0123456789abcdef"}));
    REQUIRE(grids.size() == 1);
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(grids[0]);
    REQUIRE(grid);
    CHECK(grid->getName() == "surface");
    CHECK(grid->getGridClass() == openvdb::GRID_LEVEL_SET);
    CHECK(grid->metaValue<double>("time") == 4.0 / 3.0);
    CHECK(grid->metaValue<openvdb::Int32>("frame") == 40);
    CHECK(grid->metaValue<std::string>("scene_hash") == "0123456789abcdef");
    CHECK(grid->voxelSize().x() == Approx(cell));
    const openvdb::Vec3d middle(origin.x + double(center.x), origin.y + double(center.y), origin.z + double(center.z));
    std::size_t count = 0;
    for (auto value = grid->cbeginValueOn(); value; ++value, ++count) {
        const double distance = (grid->indexToWorld(value.getCoord()) - middle).length() - radius;
        // A triangle whose circle has a radius of a cell lies up to cell^2 / (2 radius) below the sphere. Further away,
        // OpenVDB takes a triangle nearby that is not always the nearest.
        const double chord = 0.5 * cell * cell / radius;
        REQUIRE(double(*value) == Approx(distance).margin(std::abs(distance) < cell ? chord : 0.2 * cell));
    }
    // Three voxels on each side of the sphere.
    CHECK(static_cast<double>(count) == Approx(6.0 * 4.0 * 3.1416 * std::pow(radius / cell, 2.0)).epsilon(0.1));
    CHECK(grid->background() == Approx(3.0 * cell));
    CHECK(grid->tree().getValue(openvdb::Coord::round(grid->worldToIndex(middle))) == -grid->background());
}

TEST_CASE("OpenVDB reads the level set of an empty mesh", "[mesh]") {
    const openvdb::GridPtrVec grids = gridsIn(render::encodeLevelSet({}, {}));
    REQUIRE(grids.size() == 1);
    CHECK(grids[0]->activeVoxelCount() == 0);
}
