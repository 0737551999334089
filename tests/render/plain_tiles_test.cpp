// What is kept from the picture before must be what would be drawn.
#include "tests/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "render/cpu/shading/background_tiles.h"
#include "tests/render/pictures.h"

using pictures::drawn;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{230, 130};

struct Change {
    std::string name;
    std::function<void(render::View&)> make;
};

/// Each on top of those before.
std::vector<Change> changes() {
    return {{"nothing", [](render::View&) {}},
            {"particles have moved",
             [](render::View& v) {
                 for (render::Sphere& particle : v.particles) particle.center += glm::vec3(0.7F, 0.2F, -0.4F);
             }},
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
            {"no ground", [](render::View& v) { v.ground.reset(); }}};
}

bool same(const std::vector<render::VisiblePoint>& a, const std::vector<render::VisiblePoint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.normal == other.normal && one.depth == other.depth;
    });
}

}  // namespace

TEST_CASE("Pictures drawn one after another are those drawn alone") {
    render::Context context(render::Backend::osmesa);
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
        render::View view = pictures::cloud(60);
        view.light.shadows = true;
        render::Renderer renderer(context, kSize, quality);
        renderer.draw(view);
        for (const Change& change : changes()) {
            INFO(change.name << ", quality " << static_cast<int>(quality));
            const render::View before = view;
            change.make(view);
            const render::Image alone = drawn(view, kSize, quality);
            CHECK((renderer.draw(view).rgb == alone.rgb));
            // Another view's surfaces in between, which leave its tiles and its frame in the pass.
            const std::vector<render::VisiblePoint> surfaces = renderer.visiblePoints(before);
            if (quality == Quality::draft)
                CHECK(same(surfaces, render::Renderer(context, kSize, quality).visiblePoints(before)));
            CHECK((renderer.draw(view).rgb == alone.rgb));
        }
    }
}

TEST_CASE("A picture is the same in another's memory") {
    const render::View view = pictures::cloud(60);
    render::Context context(render::Backend::osmesa);
    render::Renderer renderer(context, kSize, Quality::normal);
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

TEST_CASE("A plain tile is colored once while it shows the same before the same backdrop") {
    using render::TileClass;
    constexpr int kColumns = 3;
    constexpr render::PixelColor kMark = 0x00badbad;
    constexpr TileClass kGround = TileClass::ground;
    constexpr TileClass kPicture = TileClass::picture;
    std::vector<TileClass> classes{TileClass::background, kGround, kPicture};
    std::vector<render::PixelColor> pixels(kColumns * render::kTilePixels, kMark);
    render::Backdrop backdrop;
    backdrop.frame.width = kColumns * render::kTileSize;
    backdrop.frame.height = render::kTileSize;
    backdrop.background = {glm::vec3(1.0F), glm::vec3(1.0F)};
    backdrop.ground = {1.0F, 0.0F, 0.0F};
    backdrop.groundHeight = -1.0F;
    backdrop.fadeDistance = 1e6F;
    render::PlainTiles plain;
    // Which tiles are colored, all of it or none.
    const auto colored = [&] {
        std::ranges::fill(pixels, kMark);
        plain.color(backdrop, classes, kColumns, pixels);
        std::array<int, kColumns> counts{};
        for (std::size_t k = 0; k < pixels.size(); ++k)
            counts[k / render::kTileSize % kColumns] += pixels[k] == kMark ? 0 : 1;
        std::vector<int> tiles;
        for (int tile = 0; tile < kColumns; ++tile) {
            const int count = counts[static_cast<std::size_t>(tile)];
            CHECK((count == 0 || count == int{render::kTilePixels}));
            if (count > 0) tiles.push_back(tile);
        }
        return tiles;
    };
    CHECK(colored() == std::vector{0, 1});
    constexpr std::size_t kLastRow = (render::kTileSize - 1) * kColumns * render::kTileSize;
    CHECK(pixels[kLastRow] == 0x00ffffff);
    CHECK(pixels[kLastRow + render::kTileSize] == 0x000000ff);
    CHECK(colored().empty());
    classes = {kGround, kGround, kGround};
    CHECK(colored() == std::vector{0, 2});
    classes = {kPicture, kGround, kPicture};
    CHECK(colored().empty());
    classes = {kGround, kGround, kGround};
    CHECK(colored() == std::vector{0, 2});
    backdrop.fadeDistance = 2.0F;
    CHECK(colored() == std::vector{0, 1, 2});
    backdrop.frame.up.x = 0.1F;
    CHECK(colored() == std::vector{0, 1, 2});
    CHECK(colored().empty());
}
