// The .vdb files of meshes and of fields, read by OpenVDB's own reader.
#include "tests/catch.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <openvdb/openvdb.h>

#include "render/mesh/isosurface.h"
#include "render/mesh/sampled_field.h"
#include "render/mesh/surface_mesh.h"
#include "studies/oracle/oracle.h"
#include "tests/render/pictures.h"

namespace {

namespace fs = std::filesystem;

/// The only grid of a .vdb file with these bytes.
openvdb::FloatGrid::Ptr gridIn(const std::string& bytes) {
    openvdb::initialize();
    std::string pattern = (fs::temp_directory_path() / "globular-test-XXXXXX").string();
    const fs::path folder = ::mkdtemp(pattern.data());
    const fs::path path = folder / "mesh.vdb";
    std::ofstream(path, std::ios::binary) << bytes;
    openvdb::io::File file(path.string());
    file.open(false);  // read at once, because the file is removed
    const openvdb::GridPtrVec grids = *file.getGrids();
    file.close();
    fs::remove_all(folder);
    REQUIRE(grids.size() == 1);
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(grids[0]);
    REQUIRE(grid);
    return grid;
}

const glm::dvec3 kOrigin(1000.0, 0.0, -512.0);

/// Checks what all grids have: the cell of their transform, and the metadata of this label.
void checkLabel(const openvdb::FloatGrid& grid, const render::GridLabel& label) {
    CHECK(grid.metaValue<double>("time") == label.time);
    CHECK(grid.metaValue<openvdb::Int32>("frame") == label.frame);
    CHECK(grid.metaValue<std::string>("scene_hash") == label.sceneHash);
    CHECK(grid.voxelSize().x() == Approx(label.cell));
    const openvdb::Vec3d start = grid.indexToWorld(openvdb::Coord(0, 0, 0));
    CHECK(start == openvdb::Vec3d(label.origin.x, label.origin.y, label.origin.z));
}

}  // namespace

TEST_CASE("OpenVDB reads a level set as it was written", "[mesh]") {
    const double radius = 0.25;
    const glm::vec3 center(0.5F, 1.25F, -2.0F);
    render::View view;
    view.particles = {{center, static_cast<float>(radius), glm::vec3(0.5F)}};
    const double cell = 0.04;
    const render::GridLabel label{cell, kOrigin, 4.0 / 3.0, 40, "0123456789abcdef"};
    const auto mesh = render::surfaceMesh(view, std::vector<glm::vec3>(1), cell);
    const openvdb::FloatGrid::Ptr grid = gridIn(render::encodeLevelSet(mesh, label));
    CHECK(grid->getName() == "surface");
    CHECK(grid->getGridClass() == openvdb::GRID_LEVEL_SET);
    checkLabel(*grid, label);
    const glm::dvec3 there = kOrigin + glm::dvec3(center);
    const openvdb::Vec3d middle(there.x, there.y, there.z);
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
    CHECK(gridIn(render::encodeLevelSet({}, {}))->activeVoxelCount() == 0);
}

TEST_CASE("OpenVDB reads a field that is the oracle's everywhere", "[mesh]") {
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth}) {
        render::View view = pictures::cloud(60);
        view.style = render::Style::metaballs;
        view.field.skin = skin;
        const double cell = 0.5 * oracle::meanRadius(view);
        const render::GridLabel label{cell, kOrigin, 0.1, 3, "fedcba9876543210"};
        const float isoValue = render::surfaceThreshold(view.field);
        const openvdb::FloatGrid::Ptr grid =
            gridIn(render::encodeField(render::sampleWhole(render::BallBlocks(view, cell)), isoValue, label));
        CHECK(grid->getName() == "density");
        CHECK(grid->getGridClass() == openvdb::GRID_FOG_VOLUME);
        CHECK(grid->background() == 0.0F);
        checkLabel(*grid, label);
        CHECK(double(grid->metaValue<float>("iso_value")) == Approx(oracle::fieldThreshold(view)).epsilon(1e-6));
        const openvdb::CoordBBox around = [&] {
            openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
            box.expand(4);
            return box;
        }();
        REQUIRE(around.volume() > 10000);
        const auto values = grid->getConstAccessor();
        const oracle::Scene scene(view);
        std::size_t active = 0;
        for (auto node = around.begin(); node; ++node) {
            const openvdb::Vec3d at = grid->indexToWorld(*node);
            const double expected = oracle::fieldAt(scene, glm::dvec3(at.x(), at.y(), at.z()) - kOrigin);
            // Single precision: a sum of some tens of kernels, each off by some 1e-6.
            REQUIRE(double(values.getValue(*node)) == Approx(expected).margin(1e-4));
            REQUIRE(values.isValueOn(*node) == (values.getValue(*node) > 0.0F));
            active += values.isValueOn(*node) ? 1U : 0U;
        }
        CHECK(active == grid->activeVoxelCount());
    }
}

TEST_CASE("OpenVDB reads the field of no particles", "[mesh]") {
    const render::BallBlocks none(render::View{}, 0.1);
    CHECK(gridIn(render::encodeField(render::sampleWhole(none), 0.5F, {}))->activeVoxelCount() == 0);
}
