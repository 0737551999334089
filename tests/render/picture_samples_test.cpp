// What samples see and what is drawn together: the same bits on every instruction set, edges of boxes, squares of
// tiles.
#include "tests/catch.h"

#include <hwy/highway.h>

#include "render/camera_frame.h"
#include "render/tile_class.h"
#include "render/tile_table.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{201, 122};  // no whole number of tiles

// A view with everything that is looked up: obstacles, lines, soft shadows, openness.
render::View fullView(render::Style style, render::Projection projection) {
    render::View view = cloudWithObstacles(250);
    view.style = style;
    view.camera.projection = projection;
    view.camera.halfHeight = 2.0F;
    view.light.shadows = true;
    view.light.softness = 0.8F;
    view.ambient.occlusion = 0.8F;
    view.surface.translucency = 0.4F;
    view.surface.reflection = 0.5F;
    view.edges.push_back({{-2.0F, 0.5F, -2.0F}, {2.0F, 0.5F, 2.0F}, glm::vec3(1.0F, 0.9F, 0.0F), 1.5F});
    return view;
}

// Calls visit(name) with each instruction set that this machine has.
template <typename Visit>
void onEachInstructionSet(const Visit& visit) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        visit(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

TEST_CASE("Every instruction set draws the same pictures") {
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
            for (const float softness : {0.0F, 0.8F}) {
                render::View view = fullView(style, projection);
                view.light.softness = softness;
                std::vector<std::uint8_t> first;
                onEachInstructionSet([&](const char* name) {
                    CAPTURE(name, int(style), int(projection), softness);
                    const render::Image image = drawn(view, kSize, Quality::normal);
                    if (first.empty()) first = image.rgb;
                    CHECK((image.rgb == first));
                });
            }
        }
    }
}

TEST_CASE("The faces of a box are shaded apart where they meet within a pixel") {
    render::View view = cloudWithObstacles(0);
    view.boxObstacles.front() = {{-1.0F, 0.01F, -1.0F}, {1.0F, 1.6F, 1.0F}, {0.9F, 0.9F, 0.9F}};
    view.sphereObstacles.clear();
    view.light.shadows = false;
    // Four samples of a pixel against sixteen: with one shading for the whole box its edges stayed as rough as in a
    // draft.
    const render::Image exact = fromOracle(view, kSize, 4);
    const double draft = compare(drawn(view, kSize, Quality::draft), exact, 0).mean;
    const double normal = compare(drawn(view, kSize, Quality::normal), exact, 0).mean;
    CAPTURE(draft, normal);
    CHECK(normal < 0.6 * draft);
}

TEST_CASE("A camera inside a box sees its nearest face") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        render::View view = cloudWithObstacles(0);
        view.camera.projection = projection;
        view.camera.halfHeight = 0.3F;
        view.camera.eye = {1.2F, 0.4F, 1.95F};
        view.camera.target = {1.3F, 0.3F, 0.0F};
        const Difference difference = compare(drawn(view, kSize, Quality::draft), fromOracle(view, kSize, 1), 1);
        CAPTURE(int(projection));
        INFO(difference);
        CHECK(difference.share <= 4.0 / (201.0 * 122.0));  // on a border between nearest faces
    }
}

TEST_CASE("Squares cover every tile that is to be drawn once, and hold one class") {
    constexpr int kColumns = 11;
    constexpr int kRows = 9;
    using render::TileClass;
    std::vector<TileClass> classes(kColumns * kRows, TileClass::ground);
    classes[3] = TileClass::kept;                    // from the picture before
    classes[5 * kColumns + 6] = TileClass::picture;  // spoils a square
    classes[4 * kColumns + 1] = TileClass::background;
    const render::TileTable table = render::tileTable(classes, kColumns);
    REQUIRE(table.first.size() == render::kTileClasses + 1);
    CHECK(table.first.back() == static_cast<int>(table.rows.size()));
    std::vector<int> covered(classes.size(), 0);
    int squares = 0;
    for (std::size_t c = 0; c < render::kTileClasses; ++c) {
        for (int k = table.first[c]; k < table.first[c + 1]; ++k) {
            const render::TileRow& row = table.rows[static_cast<std::size_t>(k)];
            squares += row.side == render::kSquareSide ? 1 : 0;
            for (int y = row.row; y < row.row + row.side; ++y) {
                for (int x = row.column; x < row.column + row.side; ++x) {
                    const auto tile = static_cast<std::size_t>(y * kColumns + x);
                    ++covered[tile];
                    CHECK(classes[tile] == static_cast<TileClass>(c));
                }
            }
        }
    }
    // Of the four whole squares one lost a tile, one has background in it and one a picture.
    CHECK(squares == 1);
    for (std::size_t tile = 0; tile < classes.size(); ++tile)
        CHECK(covered[tile] == (classes[tile] == TileClass::kept ? 0 : 1));
}
