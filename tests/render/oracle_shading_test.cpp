// The oracle's metaballs and colors against closed forms and values worked by hand; its rays and shadows are tested in
// oracle_test.cpp. Where an input is not exact in float, it is read back from the view or its float rounding is allowed
// for.
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/catch.h"

#include "studies/oracle/oracle.h"
#include "tests/render/oracle_near.h"

namespace {

using glm::dvec3;
using oracle::checkNear;
using oracle::Hit;
using oracle::kEps;
using oracle::kFloatEps;
using oracle::Ray;

render::View metaballView(std::vector<render::Sphere> balls, float reach) {
    render::View view;
    view.style = render::Style::metaballs;
    view.particles = std::move(balls);
    view.field.reach = reach;
    return view;
}

/// Whether samples of the field every `step` meters along a ray, up to `end`, all stay below a level.
bool staysBelow(const render::View& view, const Ray& ray, double step, double end, double level) {
    for (int i = 0; i * step < end; ++i)
        if (oracle::fieldAt(view, ray.origin + i * step * ray.direction) >= level) return false;
    return true;
}

/// The field's gradient by central differences.
dvec3 slopeAt(const render::View& view, const dvec3& point, double step) {
    dvec3 slope{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 offset{0.0};
        offset[axis] = step;
        slope[axis] = (oracle::fieldAt(view, point + offset) - oracle::fieldAt(view, point - offset)) / (2.0 * step);
    }
    return slope;
}

/// A matt or glossy point at the origin, facing +z, seen from +z and lit from (0.96, 0, 0.28). The halfway vector is
/// (0.6, 0, 0.8).
render::View litView(float specular) {
    render::View view;
    view.light.toLight = {0.96F, 0.0F, 0.28F};
    view.light.color = {1.0F, 0.5F, 0.25F};
    view.ambient.ground = glm::vec3{0.25F};
    view.ambient.sky = glm::vec3{0.75F};
    view.surface.specular = specular;
    view.surface.glossExponent = 2;
    return view;
}

Hit facingHit(Hit::Kind kind) {
    return {kind, 5.0, dvec3{0.0}, {0.0, 0.0, 1.0}, dvec3{0.5}};
}

const Ray kFromFront{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};

render::View orthographicView(float halfHeight) {
    render::View view;
    view.camera.projection = render::Projection::orthographic;
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    view.camera.halfHeight = halfHeight;
    return view;
}

}  // namespace

TEST_CASE("oracle: a lone metaball is the sphere of its radius") {
    const float reach = GENERATE(1.2F, 2.5F, 4.0F);
    render::View view = metaballView({{{0.5F, -0.25F, 0.0F}, 0.5F, {0.25F, 0.5F, 0.75F}}}, reach);
    view.camera.eye = {0.0F, 0.5F, 4.0F};
    render::View spheres = view;
    spheres.style = render::Style::spheres;
    const render::PictureSize size{64, 48};
    int hitCount = 0;
    for (int i = 0; i < size.width * size.height; ++i) {
        const Ray ray = oracle::pixelRay(view, size, i % size.width + 0.5, i / size.width + 0.5);
        const Hit ball = oracle::trace(view, ray);
        const Hit sphere = oracle::trace(spheres, ray);
        INFO("reach " << reach << ", pixel " << i << ", distances " << ball.distance << " and " << sphere.distance);
        REQUIRE(ball.kind == sphere.kind);
        if (sphere.kind == Hit::Kind::none) continue;
        ++hitCount;
        REQUIRE(std::abs(glm::dot(sphere.normal, ray.direction)) > 1e-4);  // so that half the chord h is above 5e-5 m
        checkNear(ball.distance, sphere.distance, 1e-9);  // error of d^2 is 8 eps R^2, R <= 2, over 2 h: 7e-11
        REQUIRE(glm::distance(ball.normal, sphere.normal) <
                1e-9);  // the error of the distance over the radius 0.5: 1.4e-10
        REQUIRE(glm::distance(ball.albedo, sphere.albedo) < 4 * kEps);  // (k c)/k: 2 roundings
    }
    CHECK(hitCount > 100);
}

TEST_CASE("oracle: the field of two balls by hand") {
    // Reach 2: radii 0.5 and 1 give R = 1 and 2; the threshold is (1 - 1/4)^2. All of it is exact in binary.
    const render::View view = metaballView({{{-0.5F, 0.0F, 0.0F}, 0.5F, {}}, {{0.5F, 0.0F, 0.0F}, 0.5F, {}}}, 2.0F);
    CHECK(oracle::fieldThreshold(view) == 0.5625);
    CHECK(oracle::fieldAt(view, {0.0, 0.0, 0.0}) == 2.0 * 0.75 * 0.75);
    CHECK(oracle::fieldAt(view, {0.5, 0.0, 0.0}) == 1.0);  // the other ball ends exactly here
    CHECK(oracle::fieldAt(view, {1.5, 0.0, 0.0}) == 0.0);
    const render::View unequal = metaballView({{{-0.5F, 0.0F, 0.0F}, 0.5F, {}}, {{1.0F, 0.0F, 0.0F}, 1.0F, {}}}, 2.0F);
    CHECK(oracle::fieldAt(unequal, {0.0, 0.0, 0.0}) == 2.0 * 0.75 * 0.75);
}

TEST_CASE("oracle: a smooth skin averages two sizes the less, the more they differ") {
    // Reach 2.5, radii 0.5 and 0.75: the pair's reach is 1.5625 m, and 1 - 9 (0.25/1.25)^2 = 0.64.
    render::View view = metaballView({{{}, 0.5F, {}}, {{1.25F, 0.0F, 0.0F}, 0.75F, {}}}, 2.5F);
    view.field.skin = render::Skin::smooth;
    const double root = 1.0 - 1.5625 / (1.5625 * 1.5625);  // 0.36
    const double share = 0.64 * root * root;
    const double pull = double(render::kSkinPull) * 1.25 * share / (1.0 + share);
    const std::vector<oracle::Ball> balls = oracle::ballsOf(view);
    checkNear(balls[0].center.x, pull, 10 * kEps);  // some ten roundings of numbers near 1, as in all lines below
    checkNear(balls[1].center.x, 1.25 - pull, 10 * kEps);
    for (const oracle::Ball& ball : balls) checkNear(ball.weight, std::pow(1.0 + share, -0.75), 10 * kEps);
    checkNear(balls[0].reach, 1.25, 10 * kEps);
    checkNear(balls[1].reach, 1.875, 10 * kEps);
}

TEST_CASE("oracle: in a smooth skin a small ball shortens the kernel of a large one, and neither moves") {
    // Reach 2, radii 1 and 0.25. The large kernel ends 0.25 m before the small particle, but neither beyond 2 m nor
    // within 1 + (2 - 1) (1 + 2/4)/4 = 1.375 m.
    struct Pair {
        float distance;
        double end;
    };
    for (const Pair pair :
         {Pair{3.0F, 2.0}, Pair{2.25F, 2.0}, Pair{2.0F, 1.75}, Pair{1.25F, 1.375}, Pair{0.5F, 1.375}}) {
        CAPTURE(pair.distance);
        render::View view = metaballView({{{}, 1.0F, {}}, {{pair.distance, 0.0F, 0.0F}, 0.25F, {}}}, 2.0F);
        view.field.skin = render::Skin::smooth;
        const std::vector<oracle::Ball> balls = oracle::ballsOf(view);
        checkNear(balls[0].reach, pair.end, 4 * kEps);
        checkNear(balls[1].reach, 0.5, 4 * kEps);
        CHECK(balls[0].center == dvec3(0.0));
        CHECK(balls[1].center == dvec3(double(pair.distance), 0.0, 0.0));
        checkNear(balls[0].weight, std::pow(0.75 / (1.0 - 1.0 / (pair.end * pair.end)), 2.0), 20 * kEps);
        checkNear(balls[1].weight, 1.0, 4 * kEps);
    }
}

TEST_CASE("oracle: in a smooth skin a large ball's kernel does not shrink to that of a speck") {
    render::View view =
        metaballView({{{}, 1.0F, {}}, {{1.0F, 0.0F, 0.0F}, 1e-6F, {}}, {{0.0F, 1.0F, 0.0F}, 0.0F, {}}}, 2.0F);
    view.field.skin = render::Skin::smooth;
    const oracle::Ball ball = oracle::ballsOf(view)[0];
    checkNear(ball.reach, 1.0 + 0.01 * 1.02, kFloatEps);  // a hundredth counts
    CHECK(ball.center == dvec3(0.0));
}

TEST_CASE("oracle: a ray from inside the surface hits at once, with weighted color and the field's gradient") {
    // At the origin 1 - d^2/R^2 is 3/4 and 1/2, so the kernels are as 9 to 4, and the field falls fastest along
    // 3/4 (0.5, 0, 0) + 1/2 (-0.5, -0.5, 0) = (0.125, -0.25, 0).
    const render::View view = metaballView(
        {{{-0.5F, 0.0F, 0.0F}, 0.5F, {1.0F, 0.0F, 0.0F}}, {{0.5F, 0.5F, 0.0F}, 0.5F, {0.0F, 0.0F, 1.0F}}}, 2.0F);
    const Hit hit = oracle::trace(view, {{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}});
    CHECK(hit.kind == Hit::Kind::particle);
    CHECK(hit.distance == 0.0);
    checkNear(hit.albedo, {9.0 / 13.0, 0.0, 4.0 / 13.0}, 2 * kEps);           // one division
    checkNear(hit.normal, dvec3{1.0, -2.0, 0.0} / std::sqrt(5.0), 4 * kEps);  // a root and a division
    CHECK(oracle::trace(metaballView({}, 2.0F), kFromFront).kind == Hit::Kind::none);
    CHECK(oracle::trace(metaballView({{{}, 0.0F, {}}}, 2.0F), kFromFront).kind == Hit::Kind::none);
}

TEST_CASE("oracle: slivers that a 0.06 m step misses are found") {
    SECTION("grazing a lone ball") {
        const double shortfall = GENERATE(1e-4, 1e-6, 1e-9, 1e-12);
        const render::View view = metaballView({{{}, 0.125F, {}}}, 2.5F);
        const double off = 0.125 * (1.0 - shortfall);
        const double half = std::sqrt((0.125 - off) * (0.125 + off));
        const Ray ray{{off, 0.0, 10.0}, {0.0, 0.0, -1.0}};
        const double slope = 4.0 * 0.84 * half / (0.3125 * 0.3125);  // of the field where the ray enters, 1/m
        CAPTURE(shortfall, half);
        REQUIRE(staysBelow(view, ray, 0.06, 20.0, oracle::fieldThreshold(view)));
        checkNear(oracle::trace(view, ray).distance, 10.0 - half, 8 * kEps / slope + 16 * kEps);  // field, distance
    }
    SECTION("the bridge between two balls") {
        // On the axis between balls at x = +-s: 2 (1 - (s^2 + z^2)/R^2)^2 = T where z^2 = R^2 (1 - sqrt(T/2)) - s^2.
        const float s = 0.199124F;
        const render::View view = metaballView({{{-s, 0.0F, 0.0F}, 0.125F, {}}, {{s, 0.0F, 0.0F}, 0.125F, {}}}, 2.5F);
        const double reachSquared = 0.3125 * 0.3125;
        const double root = std::sqrt(0.7056 / 2.0);
        const double half = std::sqrt(reachSquared * (1.0 - root) - double(s) * double(s));
        REQUIRE(half > 5e-4);
        REQUIRE(half < 2e-3);
        const Ray ray{{0.0, 0.0, 10.0}, {0.0, 0.0, -1.0}};
        const double slope = 8.0 * root * half / reachSquared;
        REQUIRE(staysBelow(view, ray, 0.06, 20.0, oracle::fieldThreshold(view)));
        checkNear(oracle::trace(view, ray).distance, 10.0 - half,
                  16 * kEps / slope + 16 * kEps);  // as above, for two balls
    }
}

TEST_CASE("oracle: among random balls the hit is on the surface, faces downhill, and no sample before it is inside") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::uniform_real_distribution<float> radius(0.06F, 0.2F);
    std::vector<render::Sphere> balls(60);
    for (render::Sphere& ball : balls) ball = {{place(random), place(random), place(random)}, radius(random), {}};
    const render::View view = metaballView(balls, 2.5F);
    const double threshold = oracle::fieldThreshold(view);
    int hitCount = 0;
    for (int i = 0; i < 100; ++i) {
        const dvec3 toward{place(random), place(random), 0.0};
        const dvec3 eye{0.0, 0.0, 3.0};
        const Ray ray{eye, glm::normalize(toward - eye)};
        const Hit hit = oracle::trace(view, ray);
        CAPTURE(i, hit.distance);
        REQUIRE(staysBelow(view, ray, 0.002, std::min(hit.distance, 6.0) - 1e-9, threshold));
        if (hit.kind == Hit::Kind::none) continue;
        ++hitCount;
        // A ball's slope 4 d/R^2 (1 - d^2/R^2) is at most 1.54/R, at d = R/sqrt(3); here R > 0.15, and there are 60.
        checkNear(oracle::fieldAt(view, hit.point), threshold, 24 * kEps * 624.0);  // 4 roundings of 6 m, that slope
        // The third derivative of a kernel, 24 x/R^4, is below 7200, 60 balls; times step^2/6 that is 7.2e-8 an axis.
        const dvec3 slope = slopeAt(view, hit.point, 1e-6);
        const dvec3 mismatch = slope + glm::length(slope) * hit.normal;
        checkNear(glm::length(mismatch), 0.0, 2e-7);  // sqrt(3) times the above, rounding 8 eps 0.7/step = 1.2e-9
    }
    CHECK(hitCount > 20);
    CHECK(hitCount < 90);
}

TEST_CASE("oracle: known sRGB values, the round trip of all bytes, and values outside of [0, 1]") {
    CHECK(oracle::encodeSrgb(0.0) == 0);
    CHECK(oracle::encodeSrgb(0.002) == 7);       // 255 * 12.92 * 0.002 = 6.59
    CHECK(oracle::encodeSrgb(0.0031308) == 10);  // 255 * 0.04045 = 10.31
    CHECK(oracle::encodeSrgb(0.18) == 118);      // middle gray
    CHECK(oracle::encodeSrgb(0.5) == 188);
    CHECK(oracle::encodeSrgb(1.0) == 255);
    for (int byte = 0; byte < 256; ++byte) {
        const double encoded = byte / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        CHECK(oracle::encodeSrgb(std::min(linear, 1.0)) == byte);
    }
    CHECK_THROWS_AS(oracle::encodeSrgb(-0.1), std::domain_error);
    CHECK_THROWS_AS(oracle::encodeSrgb(1.1), std::domain_error);
    CHECK_THROWS_AS(oracle::encodeSrgb(std::nan("")), std::domain_error);
}

TEST_CASE("oracle: ambient, diffuse and glint of one point by hand") {
    // n.l = 0.28; n.h = v.h = 0.8; gloss 4: (4 + 8)/8 * 0.8^4 = 0.6144; fresnel 0.5 + 0.5 * 0.2^5 = 0.50016; their
    // product is the glint, 0.307298304.
    const dvec3 light{1.0, 0.5, 0.25};
    const dvec3 matt = 0.5 * (dvec3{0.5} + 0.28 * light);
    const dvec3 glossy = matt + 0.307298304 * light;
    const dvec3 unlit{0.25};
    const double tolerance = 4.0 * kFloatEps;  // 0.96 and 0.28 as float, half of it each, times derivatives below 4
    const auto colorOf = [](const render::View& view, Hit::Kind kind) {
        return oracle::shade(view, facingHit(kind), kFromFront, 0.0);
    };
    render::View view = litView(0.5F);
    checkNear(colorOf(view, Hit::Kind::particle), glossy, tolerance);         // derived above
    checkNear(colorOf(view, Hit::Kind::sphereObstacle), matt, tolerance);     // derived above
    checkNear(colorOf(view, Hit::Kind::boxObstacle), matt, tolerance);        // derived above
    checkNear(colorOf(litView(0.0F), Hit::Kind::particle), matt, tolerance);  // derived above
    view.sphereObstacles = {{{4.8F, 0.0F, 1.4F}, 0.5F, {}}};                  // 5 m toward the light
    checkNear(colorOf(view, Hit::Kind::particle), unlit, 4 * kEps);           // ambient alone, a few roundings
    view.light.shadows = false;
    checkNear(colorOf(view, Hit::Kind::particle), glossy, tolerance);  // derived above
    view.light.toLight = {1.92F, 0.0F, 0.56F};                         // twice as long is the same light
    checkNear(colorOf(view, Hit::Kind::particle), glossy, tolerance);  // derived above
    view.light.toLight = {0.96F, 0.0F, -0.28F};
    checkNear(colorOf(view, Hit::Kind::particle), unlit, 4 * kEps);  // ambient alone, a few roundings
}

TEST_CASE("oracle: the ground fades into the background with the fourth power of the distance") {
    render::View view;
    view.light.toLight = {0.0F, 1.0F, 0.0F};
    view.light.color = glm::vec3{0.5F};
    view.ambient.sky = glm::vec3{0.25F};
    view.background = {glm::vec3{1.0F}, glm::vec3{0.0F}};
    view.surface.specular = 0.5F;  // has no effect: the ground is matt
    view.ground = render::Ground{};
    view.ground->color = glm::vec3{0.5F};
    view.ground->center = {0.0F, 3.0F, 0.0F};
    view.ground->fadeDistance = 5.0F;
    const auto groundAt = [&](double z) {
        const Hit hit{Hit::Kind::ground, 1.0, {0.0, 0.0, z}, {0.0, 1.0, 0.0}, dvec3{0.5}};
        return oracle::shade(view, hit, kFromFront, 0.75).x;
    };
    checkNear(groundAt(4.0), 0.5 * 0.375 + 0.5 * 0.75, 16 * kEps);  // d = 5: half and half; a dozen roundings below 1
    const double far = std::sqrt(100.0 - 9.0);
    checkNear(groundAt(far), (0.375 + 16.0 * 0.75) / 17.0, 16 * kEps);  // d = 10: fade 16; a dozen roundings below 1
    CHECK(groundAt(1e90) == 0.75);                                      // fade overflows to infinity: background alone
    view.ground->center = {0.0F, 0.0F, 4.0F};
    CHECK(groundAt(4.0) == 0.375);  // no fade at the center
}

TEST_CASE("oracle: a picture runs from the top left, with the background's top color above") {
    render::View view = orthographicView(2.0F);
    view.background = {{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    view.particles = {{{-3.5F, 1.5F, 0.0F}, 0.4F, {}}};
    const oracle::Picture picture = oracle::draw(view, {8, 4}, 1);
    REQUIRE(picture.rgb.size() == 3 * 8 * 4);
    CHECK(std::count(picture.kinds.begin(), picture.kinds.end(), Hit::Kind::none) == 31);
    CHECK(picture.kinds.front() == Hit::Kind::particle);
    checkNear(picture.distances.front(), 9.6, kFloatEps);  // the radius 0.4 in float
    CHECK(std::isinf(picture.distances.back()));
    for (std::size_t y = 0; y < 4; ++y) {
        const double t = 1.0 - (double(y) + 0.5) / 4.0;
        const double threshold = oracle::ditherThreshold(7, static_cast<int>(y));
        CHECK(picture.rgb[3 * (8 * y + 7)] == oracle::encodeSrgb(t, threshold));
        CHECK(picture.rgb[3 * (8 * y + 7) + 2] == oracle::encodeSrgb(1.0 - t, threshold));
    }
}

TEST_CASE("oracle: thresholds are Bayer's") {
    CHECK(oracle::ditherThreshold(0, 0) == 0.5 / 64.0);
    CHECK(oracle::ditherThreshold(1, 0) == 32.5 / 64.0);
    CHECK(oracle::ditherThreshold(0, 1) == 48.5 / 64.0);
    CHECK(oracle::ditherThreshold(1, 1) == 16.5 / 64.0);
    CHECK(oracle::ditherThreshold(2, 0) == 8.5 / 64.0);
    CHECK(oracle::ditherThreshold(12, 8) == 2.5 / 64.0);
}

TEST_CASE("oracle: samples are clamped, then averaged in linear light") {
    const int samplesPerAxis = GENERATE(2, 4);     // even, so that half of the samples are left of the middle
    const std::vector<std::uint8_t> gray(3, 187);  // 187.52, and the first pixel's threshold is 1/128
    render::View view = orthographicView(1.0F);
    view.background = {glm::vec3{1.0F}, glm::vec3{0.0F}};
    CHECK(oracle::draw(view, {1, 1}, samplesPerAxis).rgb == gray);
    view.background = {};
    view.ambient.sky = view.ambient.ground = glm::vec3{4.0F};
    // Four times white on the left half.
    view.boxObstacles = {{{-5.0F, -5.0F, -1.0F}, {0.0F, 5.0F, 0.0F}, glm::vec3{1.0F}}};
    CHECK(oracle::draw(view, {1, 1}, samplesPerAxis).rgb == gray);
}
