// A renderer reuses memory from one picture to the next, which must not show; and the tiles that it colors without
// samples.
#include "tests/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "render/cpu/picture_colors.h"
#include "render/cpu/shading/shade.h"
#include "tests/render/pictures.h"
#include "tests/render/solid_meshes.h"

using pictures::drawn;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{118, 66};

struct Change {
    std::string name;
    std::function<void(render::View&)> make;
};

/// Changes of a view, each made on top of those before.
std::vector<Change> changes() {
    return {{"nothing", [](render::View&) {}},
            {"particles have moved",
             [](render::View& v) {
                 for (render::Sphere& particle : v.particles) particle.center += glm::vec3(0.7F, 0.2F, -0.4F);
             }},
            {"a mesh",
             [](render::View& v) {
                 v.meshObstacles.push_back({pictures::meshTorus(0.8, 0.3, 40), glm::mat3(1.0F), {0.2F, 1.0F, 1.0F}});
             }},
            {"the mesh has moved", [](render::View& v) { v.meshObstacles[0].position.x += 0.3F; }},
            {"the mesh is turned",
             [](render::View& v) {
                 v.meshObstacles[0].rotation = pictures::rotationAround({1.0F, 0.5F, 0.0F}, 0.8F);
             }},
            {"the mesh has another color",
             [](render::View& v) {
                 v.meshObstacles[0].color = {0.7F, 0.1F, 0.1F};
             }},
            {"another mesh is in its place",
             [](render::View& v) { v.meshObstacles[0].mesh = pictures::meshSphere(0.7, 40); }},
            {"particles are gone", [](render::View& v) { v.particles.resize(3); }},
            {"the background's top",
             [](render::View& v) {
                 v.background.top = {0.1F, 0.2F, 0.9F};
             }},
            {"its bottom",
             [](render::View& v) {
                 v.background.bottom = {0.9F, 0.3F, 0.2F};
             }},
            {"the ground's height", [](render::View& v) { v.ground->height -= 0.2F; }},
            {"the ground's center", [](render::View& v) { v.ground->center.x += 2.0F; }},
            {"the ground's color",
             [](render::View& v) {
                 v.ground->color = {0.7F, 0.2F, 0.1F};
             }},
            {"the ground's fading", [](render::View& v) { v.ground->fadeDistance = 3.0F; }},
            {"the light's color",
             [](render::View& v) {
                 v.light.color = {0.2F, 0.9F, 0.4F};
             }},
            {"the light's direction",
             [](render::View& v) {
                 v.light.toLight = {0.1F, 1.0F, -0.6F};
             }},
            {"the sky",
             [](render::View& v) {
                 v.ambient.sky = {0.1F, 0.1F, 0.6F};
             }},
            {"the exposure", [](render::View& v) { v.exposure = 1.7F; }},
            {"the eye", [](render::View& v) { v.camera.eye.x += 0.3F; }},
            {"the target", [](render::View& v) { v.camera.target.y += 0.3F; }},
            {"the field of view", [](render::View& v) { v.camera.verticalFov *= 1.2F; }},
            {"the projection alone",
             [](render::View& v) {
                 v.camera.projection = render::Projection::orthographic;
                 v.camera.halfHeight = std::tan(0.5F * v.camera.verticalFov);
             }},
            {"a plane as large as the picture", [](render::View& v) { v.camera.halfHeight = 3.0F; }},
            {"many more particles", [](render::View& v) { v.particles = pictures::cloud(900).particles; }},
            {"lines",
             [](render::View& v) {
                 v.edges.push_back({{-9.0F, 3.0F, -9.0F}, {9.0F, 4.0F, -9.0F}});
             }},
            {"no lines", [](render::View& v) { v.edges.clear(); }},
            {"a box",
             [](render::View& v) {
                 v.boxObstacles.push_back({{-2.0F, 0.1F, -2.0F}, {2.0F, 2.5F, -1.0F}, {0.2F, 0.3F, 0.7F}});
             }},
            {"no box", [](render::View& v) { v.boxObstacles.clear(); }},
            {"metaballs", [](render::View& v) { v.style = render::Style::metaballs; }},
            {"metaballs have moved",
             [](render::View& v) {
                 for (render::Sphere& particle : v.particles) particle.center.x -= 0.9F;
             }},
            {"no shadows", [](render::View& v) { v.light.shadows = false; }},
            {"the mesh has moved without shadows", [](render::View& v) { v.meshObstacles[0].position.y += 0.3F; }},
            {"no ground", [](render::View& v) { v.ground.reset(); }}};
}

bool same(const std::vector<render::VisiblePoint>& a, const std::vector<render::VisiblePoint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.normal == other.normal && one.depth == other.depth;
    });
}

}  // namespace

TEST_CASE("Pictures drawn one after another are those drawn alone") {
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
        render::View view = pictures::cloud(60);
        view.light.shadows = true;
        render::Renderer renderer(kSize, quality);
        renderer.draw(view);
        for (const Change& change : changes()) {
            INFO(change.name << ", quality " << static_cast<int>(quality));
            const render::View before = view;
            change.make(view);
            const render::Image alone = drawn(view, kSize, quality);
            CHECK((renderer.draw(view).rgb == alone.rgb));
            // The visible points of another view leave its tiles and its frame in the picture pass.
            const std::vector<render::VisiblePoint> points = renderer.visiblePoints(before);
            if (quality == Quality::draft) CHECK(same(points, render::Renderer(kSize, quality).visiblePoints(before)));
            CHECK((renderer.draw(view).rgb == alone.rgb));
        }
    }
}

TEST_CASE("A picture is the same in another's memory") {
    const render::View view = pictures::cloud(60);
    render::Renderer renderer(kSize, Quality::normal);
    const render::Image alone = renderer.draw(view);
    for (const int side : {1, 500}) {
        render::Image old{side, side, {}};
        old.rgb.assign(old.byteCount(), 77);
        const render::Image image = renderer.draw(view, std::move(old));
        CHECK(image.width == kSize.width);
        CHECK(image.height == kSize.height);
        CHECK((image.rgb == alone.rgb));
    }
}

TEST_CASE("Tiles of background and of open ground are colored where they stand") {
    constexpr std::size_t kColumns = 3;
    constexpr render::PixelColor kMark = 0x00badbad;
    std::vector<render::PixelColor> pixels(kColumns * render::kTilePixels, kMark);
    render::ShadingGeometry geometry;
    geometry.frame.width = int{kColumns} * render::kTileSize;
    geometry.frame.height = render::kTileSize;
    geometry.ground = -1.0F;
    render::Shading shading;
    shading.background = {glm::vec3(1.0F), glm::vec3(1.0F)};
    shading.openGround = {1.0F, 0.0F, 0.0F};
    shading.fadeDistance = 1e6F;
    for (const std::size_t tile : {std::size_t{0}, std::size_t{1}})
        render::colorBackgroundTile(geometry, shading, tile == 1,
                                    {{static_cast<int>(tile) * render::kTileSize, 0},
                                     &pixels[tile * render::kTileSize],
                                     kColumns * render::kTileSize});
    const auto count = [&](std::size_t tile, render::PixelColor color) {
        std::size_t found = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k)
            found += k / render::kTileSize % kColumns == tile && pixels[k] == color ? 1U : 0U;
        return found;
    };
    CHECK(count(0, 0x00ffffff) == render::kTilePixels);
    // The frame looks along the ground, which is seen in the lower half of the picture; the rows above are not of
    // interest.
    CHECK(count(1, 0x000000ff) >= render::kTilePixels / 2);
    CHECK(count(2, kMark) == render::kTilePixels);
}

TEST_CASE("A tile of background is kept while it shows the same in front of the same camera") {
    using Kind = render::TileKind;
    render::BackgroundCache cache;
    render::ShadingGeometry geometry;
    render::Shading shading;
    const auto keeps = [&](Kind first, Kind second) {
        cache.begin(geometry, shading, 2);
        return std::array{cache.keeps(0, first), cache.keeps(1, second)};
    };
    CHECK(keeps(Kind::background, Kind::openGround) == std::array{false, false});
    CHECK(keeps(Kind::background, Kind::openGround) == std::array{true, true});
    CHECK(keeps(Kind::openGround, Kind::openGround) == std::array{false, true});
    CHECK(keeps(Kind::mixed, Kind::mixed) == std::array{false, false});
    CHECK(keeps(Kind::mixed, Kind::openGround) == std::array{false, false});
    CHECK(keeps(Kind::mixed, Kind::openGround) == std::array{false, true});
    shading.fadeDistance = 2.0F;
    CHECK(keeps(Kind::mixed, Kind::openGround) == std::array{false, false});
    geometry.frame.up.x = 0.1F;
    CHECK(keeps(Kind::mixed, Kind::openGround) == std::array{false, false});
    geometry.frame.eye.x = 3.0F;  // everything else is relative to the eye
    CHECK(keeps(Kind::mixed, Kind::openGround) == std::array{false, true});
}
