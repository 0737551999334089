// The ray cast of metaballs against the oracle's exact roots: hits, depths, colors, shadows.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <hwy/highway.h>

#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/metaballs/metaball_frame.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/prepare/lighting/depth_map_grid.h"
#include "render/prepare/metaball_scene.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr render::PictureSize kManyRays{300, 200};  // so that some graze

render::View blobs(int count) {
    render::View view = cloud(count);
    view.style = render::Style::metaballs;
    return view;
}

/// View depths of the cast, pixel by pixel, in meters; 0 where nothing is hit.
std::vector<double> castDepths(const render::View& view, render::PictureSize size, bool isSparse = false) {
    const render::CameraFrame frame = render::cameraFrame(view.camera, size);
    render::MetaballScene scene = render::metaballScene(frame, view, render::skinOf(view));
    render::setAttributes(view, {}, scene);
    render::MetaballHits found;
    render::castMetaballs(scene, {{}, false, isSparse}, found);
    const int columns = (size.width + render::kTileSize - 1) / render::kTileSize;
    std::vector<double> depths;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::int32_t slot = found.slots[static_cast<std::size_t>(y / 16 * columns + x / 16)];
            const auto index = static_cast<std::size_t>(slot * 256 + y % 16 * 16 + x % 16);
            depths.push_back(slot < 0 ? 0.0 : double(found.hits[index].depth()));
        }
    }
    return depths;
}

struct DepthCheck {
    int hits = 0;          // of both
    int otherMask = 0;     // pixels where only one hits something
    int otherSurface = 0;  // hits more than a tenth of a radius apart
    double largest = 0.0;  // distance of all other hits, in radii
};

/// The cast's depths against the oracle's.
DepthCheck checkDepths(const render::View& view, render::PictureSize size) {
    const std::vector<double> depths = castDepths(view, size);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.camera.target) - glm::dvec3(view.camera.eye));
    constexpr double kRadius = 0.08;  // the smallest of the cloud
    const oracle::Scene scene(view, true);
    DepthCheck check;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const oracle::Ray ray = oracle::pixelRay(view, size, x + 0.5, y + 0.5);
            const oracle::Hit hit = oracle::trace(scene, ray);
            const double depth = depths[static_cast<std::size_t>(y * size.width + x)];
            const bool expected = hit.kind == oracle::Hit::Kind::particle;
            check.otherMask += expected != (depth > 0.0) ? 1 : 0;
            if (!expected || depth == 0.0) continue;
            ++check.hits;
            const double error = std::abs(depth - hit.distance * glm::dot(ray.direction, forward)) / kRadius;
            check.otherSurface += error > 0.1 ? 1 : 0;
            if (error <= 0.1) check.largest = std::max(check.largest, error);
        }
    }
    return check;
}

void requireSurface(render::View view, render::PictureSize size, double largest) {
    view.ground.reset();
    const DepthCheck check = checkDepths(view, size);
    CAPTURE(size.width, check.hits, check.otherMask, check.otherSurface, check.largest);
    CHECK(check.hits > size.width * size.height / 6);  // a good part of the picture is compared
    CHECK(check.otherMask <= 4);     // grazing rays: the field's maximum lies within a rounding of the threshold
    CHECK(check.otherSurface <= 4);  // grazing rays at silhouettes before other balls
    // Single precision (1e-6 of the depth) over the slope of the field, which is flat at grazing rays; more rays graze
    // more.
    CHECK(check.largest < largest);
}

void requireSurface(const render::View& view) {
    requireSurface(view, kSize, 5e-4);
    requireSurface(view, kManyRays, 2e-3);
}

render::View smoothBalls(std::vector<render::Sphere> balls) {
    render::View view = blobs(0);
    view.field.skin = render::Skin::smooth;
    view.particles = std::move(balls);
    return view;
}

/// Tolerance of radiusSeen(), m: single precision (1e-6) of depths up to 5 m.
constexpr double kSeenTolerance = 5e-6;

/// How far the surface lies from a ball's center on a ray that comes from this axis, by the cast's depth, m.
double radiusSeen(render::View view, const render::Sphere& ball, glm::vec3 from) {
    constexpr float kDistance = 4.0F;
    view.camera.projection = render::Projection::orthographic;
    view.camera.halfHeight = 0.5F;
    view.camera.target = ball.center;
    view.camera.eye = ball.center + kDistance * from;
    view.camera.up = from.y == 0.0F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
    constexpr render::PictureSize kOdd{33, 33};  // so that the ray of a pixel meets the center
    return double(kDistance) - castDepths(view, kOdd)[33 * 16 + 16];
}

/// Checks that the field has its threshold at a ball's radius along each axis.
void checkSurfaceAround(const render::View& view, const render::Sphere& ball) {
    const double threshold = oracle::fieldThreshold(view);
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec3 at = glm::dvec3(ball.center) + side * double(ball.radius) * axis;
            // Rounding of the view's floats over the smallest size.
            CHECK(std::abs(oracle::fieldAt(view, at) - threshold) < 1e-5);
        }
}

}  // namespace

TEST_CASE("Metaballs are where the exact roots of the field are") {
    render::View view = blobs(200);
    requireSurface(view);
    view.camera.projection = render::Projection::orthographic;
    view.camera.halfHeight = 2.0F;
    requireSurface(view);
    view.field.reach = 1.5F;
    requireSurface(view);
    view.field.reach = 4.0F;
    requireSurface(view);
}

TEST_CASE("Where metaballs are smooth, rays interpolated between cast ones are near to cast ones") {
    // A radius of 0.1 m at 5 m is 27 pixels of 1000, seven of 250 and three of 100.
    for (const int height : {1000, 250, 100}) {
        const render::PictureSize size{height * 3 / 2, height};
        render::View view = blobs(300);
        view.field = {3.0F, render::Skin::smooth};
        const std::vector<double> all = castDepths(view, size);
        const std::vector<double> sparse = castDepths(view, size, true);
        int hits = 0;
        int interpolated = 0;
        int lost = 0;
        int wrong = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            lost += (all[k] > 0.0) != (sparse[k] > 0.0) ? 1 : 0;
            if (all[k] <= 0.0 || sparse[k] <= 0.0) continue;
            ++hits;
            interpolated += all[k] != sparse[k] ? 1 : 0;
            // The limit of smoothness is a fiftieth of the smallest radius between two tangent planes, and their mean
            // is nearer.
            wrong += std::abs(all[k] - sparse[k]) < 0.02 * 0.08 ? 0 : 1;
        }
        CAPTURE(height, hits, interpolated, lost, wrong);
        REQUIRE(hits > 1000);
        CHECK(lost == 0);
        CHECK(wrong <=
              2);  // rims that show between cast rays only; counted over 130 clouds: one in 15,000 hits or fewer
        if (height == 1000)
            CHECK(interpolated > 0.4 * hits);  // counted once: half; a quarter is cast, the others are rough
    }
}

TEST_CASE("In a smooth skin a lone ball keeps its radius beside any other size") {
    for (const float ratio : {1.0F, 2.0F, 10.0F, 25.0F}) {
        for (const float reach : {1.5F, 2.5F, 4.0F}) {
            const float small = 1.0F / ratio;
            // A little more than kernels reach beyond surfaces.
            const float gap = 1.01F * (reach - 1.0F) * std::min(1.0F, (1.0F + 2.0F * small) * small);
            render::View view = smoothBalls({{{0.0F, 1.0F, 0.0F}, 1.0F}, {{1.0F + gap + small, 1.0F, 0.0F}, small}});
            view.field.reach = reach;
            CAPTURE(ratio, reach);
            for (const render::Sphere& ball : view.particles) {
                checkSurfaceAround(view, ball);
                CHECK(std::abs(radiusSeen(view, ball, {0.0F, 0.0F, 1.0F}) - double(ball.radius)) < kSeenTolerance);
            }
        }
    }
}

TEST_CASE("In a smooth skin a large ball under small ones stays on the ground, and so do small ones beside it") {
    for (const float ratio : {4.0F, 10.0F, 25.0F}) {
        const float small = 1.0F / ratio;
        render::View view = smoothBalls({{{0.0F, 1.0F, 0.0F}, 1.0F}});
        // On the ground a small ball touches the large one where (1 + s)^2 = (1 - s)^2 + x^2.
        view.particles.push_back({{2.0F * std::sqrt(small), small, 0.0F}, small, glm::vec3(0.5F)});
        const render::Sphere large = view.particles[0];
        const render::Sphere beside = view.particles[1];
        // The upper half is covered with small balls along a golden spiral.
        const int count = static_cast<int>(2.0F * ratio * ratio);
        for (int k = 0; k < count; ++k) {
            const float up = (float(k) + 0.5F) / float(count);
            const float angle = 2.399963F * float(k);
            const glm::vec3 toward(std::sqrt(1.0F - up * up) * std::cos(angle), up,
                                   std::sqrt(1.0F - up * up) * std::sin(angle));
            view.particles.push_back({large.center + (1.0F + small) * toward, small, glm::vec3(0.5F)});
        }
        CAPTURE(ratio, count);
        const std::vector<render::SkinBall> skin = render::skinOf(view);
        CHECK(skin[0].center == large.center);
        CHECK(skin[1].center == beside.center);
        CHECK(std::abs(radiusSeen(view, large, {0.0F, -1.0F, 0.0F}) - 1.0) < kSeenTolerance);
        // The kernel of the large ball ends 1.5 (1 + 2 s) s above its surface, the ground lies up to sqrt(1 + 4 s) - 1
        // above it there, which is more only for smaller balls than s = 1/8.
        const double under = radiusSeen(view, beside, {0.0F, -1.0F, 0.0F}) - double(small);
        CHECK(std::abs(under) < (ratio > 8.0F ? kSeenTolerance : 0.1 * double(small)));
        // The tops of the small balls stand out from the large one no farther than they do as spheres, or a little more
        // where many kernels overlap.
        const double top = radiusSeen(view, large, {0.0F, 1.0F, 0.0F});
        CHECK(top > 1.0);
        CHECK(top < 1.0 + 2.5 * double(small));
    }
}

TEST_CASE("Balls of one size have a kernel of one length in a smooth skin") {
    render::View view = blobs(300);
    view.field = {3.0F, render::Skin::smooth};
    for (render::Sphere& particle : view.particles) particle.radius = 0.13F;
    for (const render::SkinBall& ball : render::skinOf(view)) {
        REQUIRE(ball.reach == 3.0F * 0.13F);
        REQUIRE(ball.weight <= 1.0F);
    }
}

TEST_CASE("Balls of very different sizes are where the exact roots of a smooth field are") {
    render::View view = blobs(120);
    view.field.skin = render::Skin::smooth;
    for (std::size_t k = 0; k < view.particles.size(); k += 40) view.particles[k].radius *= 5.0F;
    requireSurface(view);
    view.field.reach = 4.0F;
    requireSurface(view);
}

TEST_CASE("What a ray hits does not depend on the rays that it is cast with") {
    render::View view = blobs(200);
    for (const render::Projection projection : {render::Projection::perspective, render::Projection::orthographic}) {
        view.camera.projection = projection;
        view.camera.halfHeight = 1.5F;
        const render::CameraFrame frame = render::cameraFrame(view.camera, {64, 48});
        render::MetaballScene scene = render::metaballScene(frame, view, render::skinOf(view));
        render::setAttributes(view, {}, scene);
        int hits = 0;
        int differing = 0;
        for (std::size_t tile = 0; tile + 1 < scene.tiles.begin.size(); ++tile) {
            render::RayBlock together;
            render::placeRays(together, render::tileCorner(scene.tiles, tile), render::kZCurve, {});
            render::castBlock(scene, tile, together);
            for (std::size_t k = 0; k < together.count; ++k) {
                render::RayBlock alone;
                render::placeRays(alone, render::tileCorner(scene.tiles, tile), std::array{render::kZCurve[k]}, {});
                render::castBlock(scene, tile, alone);
                const bool isHit = together.depth[k] >= 0.0F;
                hits += isHit ? 1 : 0;
                bool same = alone.depth[0] == together.depth[k] && alone.maxField[0] == together.maxField[k];
                for (std::size_t axis = 0; axis < 3 && isHit; ++axis)
                    same = same && alone.normal[axis][0] == together.normal[axis][k] &&
                           alone.color[axis][0] == together.color[axis][k];
                differing += same ? 0 : 1;
            }
        }
        CHECK(hits > 500);
        CHECK(differing == 0);
    }
}

TEST_CASE("A lone metaball is a sphere") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = blobs(0);
    view.particles.push_back({{0.0F, 1.0F, 0.0F}, 0.8F, {0.9F, 0.4F, 0.2F}});
    const render::Image ball = drawn(by, view, kSize, Quality::draft);
    view.style = render::Style::spheres;
    // 16-bit normals and the glint's power of 32. OpenGL interpolates normals over three times the CPU's distance.
    const int limit = by == By::cpu ? 2 : 4;
    const Difference difference = compare(ball, drawn(by, view, kSize, Quality::draft), limit);
    INFO(difference);
    CHECK(difference.share <= 4.0 / 9075.0);  // 4 pixels on outlines
}

TEST_CASE("Metaballs have the oracle's colors") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = blobs(150);
    view.sphereObstacles.push_back({{-1.4F, 0.5F, 1.4F}, 0.5F, {0.8F, 0.2F, 0.2F}});
    view.boxObstacles.push_back({{0.81F, 0.01F, 1.2F}, {1.6F, 0.7F, 2.0F}, {0.2F, 0.3F, 0.7F}});
    const Difference difference = differenceFromOracle(by, view, kSize, 2);
    INFO(difference);
    CHECK(difference.share <= 10.0 / 9075.0);  // 2 steps: packed normals as above; 10 pixels on outlines
    CHECK(difference.mean < 0.02);             // rounding: one channel in fifty is a step off; counted once: 0.008
}

TEST_CASE("In parallel projection the ground hides metaballs from where the rays begin") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    // A wall of balls above and below the ground; the eye is so low that the rays of half the picture begin under the
    // ground.
    render::View view = blobs(0);
    for (int k = 0; k < 25 * 25 * 2; ++k)
        view.particles.push_back(
            {0.15F * glm::vec3(k % 25 - 12, k / 25 % 25 - 12, -(k / 625)), 0.1F, {0.1F, 0.2F, 0.9F}});
    view.camera.projection = render::Projection::orthographic;
    view.camera.eye = {0.0F, 0.14F, 5.0F};
    view.camera.target = {0.0F, 0.09F, 0.0F};
    view.camera.halfHeight = 0.64F;
    REQUIRE(view.ground);
    view.ground->height = 0.0F;
    const Difference difference = differenceFromOracle(by, view, kSize, 20);
    INFO(difference);
    CHECK(difference.share <= 10.0 / 9075.0);  // 20 steps: interpolated normals; 10 pixels on outlines
}

TEST_CASE("Metaballs cast the oracle's shadows up to the depth map's resolution") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = blobs(150);
    view.light.shadows = true;
    const render::Image shaded = drawn(by, view, kSize, Quality::draft);
    const Difference difference = compare(shaded, fromOracle(view, kSize, 1), 3);
    INFO(difference);
    CHECK(difference.share < 0.015);  // filtered outlines of shadows, counted once: 0.009; without any shadow 0.095
    CHECK(difference.mean < 0.5);  // half the contrast (some 60 steps) of a sixtieth of the pixels; counted once: 0.28
    view.light.shadows = false;
    CHECK(compare(shaded, drawn(by, view, kSize, Quality::draft), 3).share > 0.05);  // counted once: 0.095
}

TEST_CASE("Better quality is nearer to the exact metaballs", "[long]") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    const render::View view = blobs(150);
    const render::Image exact = fromOracle(view, kSize, 4);
    const double draft = compare(drawn(by, view, kSize, Quality::draft), exact, 0).mean;
    const double normal = compare(drawn(by, view, kSize, Quality::normal), exact, 0).mean;
    const double final = compare(drawn(by, view, kSize, Quality::final), exact, 0).mean;
    CAPTURE(draft, normal, final);
    CHECK(normal < 0.6 * draft);   // four samples at silhouettes have half the error of one
    CHECK(final < 0.75 * normal);  // nine samples everywhere
}

TEST_CASE("Every instruction set gives the same bits") {
    render::View view = blobs(200);
    view.particles.push_back({view.camera.eye, 0.3F, {0.1F, 0.2F, 0.3F}});  // rays start inside a ball, too
    const render::CameraFrame frame = render::cameraFrame(view.camera, {200, 150});
    const render::LightBasis light = render::lightBasis(view.light.toLight);
    std::vector<render::SkyVisibility> sky;
    for (std::size_t k = 0; k < view.particles.size(); ++k) {
        const float part = 0.001F * static_cast<float>(k);
        sky.push_back({part, 1.0F - part, 0.5F, 0.5F + part, 0.9F, 0.1F});
    }
    view.field.skin = render::Skin::smooth;
    std::vector<std::uint32_t> first;
    std::vector<std::uint16_t> firstHeights;
    std::vector<float> firstBalls;
    int sets = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        const std::vector<render::SkinBall> skin = render::skinOf(view);
        std::vector<float> balls;
        for (const render::SkinBall& ball : skin)
            balls.insert(balls.end(), {ball.center.x, ball.center.y, ball.center.z, ball.weight, ball.reach});
        render::MetaballScene scene = render::metaballScene(frame, view, skin);
        render::setAttributes(view, sky, scene);
        render::MetaballHits found;
        render::castMetaballs(scene, {glm::vec2(0.0F), true, true}, found);
        std::vector<std::uint32_t> bits;
        for (const render::PackedHit& hit : found.hits)
            bits.insert(bits.end(), {hit.depthBits, hit.normal, hit.color, hit.sky});
        for (const render::SilhouetteHits& silhouettes : found.silhouettes)
            for (const render::SilhouetteSample& s : silhouettes.samples) bits.insert(bits.end(), {s.pixel, s.sample});
        const render::DepthMapGrid grid = render::depthMapGrid(light, view, skin, 256);
        const render::CameraFrame seenByLight = render::lightFrame(light, grid, view.camera.eye, 1);
        const std::vector<std::uint16_t> heights =
            render::castDepthMap(grid, render::metaballScene(seenByLight, view, skin)).heights;
        CAPTURE(hwy::TargetName(target));
        if (sets++ == 0) first = bits;
        if (sets == 1) firstHeights = heights;
        if (sets == 1) firstBalls = balls;
        CHECK(bits == first);
        CHECK(heights == firstHeights);
        CHECK(balls == firstBalls);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    CHECK(sets >= 1);  // several on x86 (SSSE3, SSE4, AVX2, ...), perhaps one elsewhere
}
