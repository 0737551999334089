// Triangle meshes as obstacles: what is seen of them, their shadows, and what stands before and behind them.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "render/output/png.h"
#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

/// Writes a picture to the folder in the environment variable GLOBULAR_TEST_PICTURES, to be looked at.
void show(const char* name, const render::Image& image) {
    const char* folder = std::getenv("GLOBULAR_TEST_PICTURES");
    if (folder == nullptr) return;
    const std::vector<std::uint8_t> bytes = render::encodePng(image);
    std::ofstream(std::string(folder) + '/' + name + ".png", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Up to how many steps a mesh and a box may differ. In normal quality, the shares of the pixels at the outline of a
/// box are exact, and those of a mesh are up to a quarter off, as its four samples tell them: of a contrast of 100
/// steps.
int limitOf(Quality quality) {
    return quality == Quality::normal ? 25 : 1;
}

}  // namespace

TEST_CASE("Meshes among particles are drawn as by the oracle", "[meshes]") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        for (const auto style : {render::Style::spheres, render::Style::metaballs}) {
            render::View view = cloudWithMeshes(60);
            view.style = style;
            view.camera.projection = projection;
            view.camera.halfHeight = 2.0F;
            const Difference difference = differenceFromOracle(By::cpu, view, kSize, 1);
            INFO("projection " << int(projection) << ", style " << int(style) << ": " << difference);
            // Pixels on outlines, where single precision may decide otherwise; metaballs are cast at every second
            // pixel.
            CHECK(difference.share <= (style == render::Style::spheres ? 6.0 : 40.0) / kPixels);
        }
    }
}

TEST_CASE("Samples at outlines of meshes are averaged as by the oracle", "[meshes]") {
    render::View view = cloudWithMeshes(60);
    for (const Quality quality : {Quality::normal, Quality::final}) {
        const Difference difference = compare(drawn(view, kSize, quality), fromOracle(view, kSize, 6), 16);
        INFO("quality " << int(quality) << ": " << difference);
        // In normal quality four samples stand for 36. Chosen: the same limits hold for spheres and boxes.
        CHECK(difference.mean < (quality == Quality::normal ? 1.2 : 0.7));
        CHECK(difference.share < (quality == Quality::normal ? 0.06 : 0.02));
    }
}

TEST_CASE("The shadows of meshes are the oracle's", "[meshes]") {
    for (const float softness : {0.0F, 0.3F, 1.0F}) {
        render::View view = cloudWithMeshes(60);
        view.light.shadows = true;
        view.light.softness = softness;
        view.ambient.occlusion = 0.7F;
        show("cloud", drawn(view, {1280, 720}, Quality::normal));
        const Difference difference = differenceFromOracle(By::cpu, view, kSize, 24);
        INFO("softness " << softness << ": " << difference);
        // The map of heights makes sharp edges three of its texels wide, and the oracle takes nine rays for a soft one.
        CHECK(difference.share < 0.02);
        CHECK(difference.mean < 1.0);
    }
}

TEST_CASE("The shadows of meshes on metaballs, and of metaballs on meshes, are the oracle's", "[meshes]") {
    render::View view = cloudWithMeshes(60);
    view.style = render::Style::metaballs;
    view.light.shadows = true;
    view.light.softness = 0.5F;
    const Difference difference = differenceFromOracle(By::cpu, view, kSize, 24);
    INFO(difference);
    CHECK(difference.share < 0.02);
    CHECK(difference.mean < 1.0);
}

TEST_CASE("A finely meshed sphere looks like the exact one", "[meshes]") {
    for (const float softness : {0.0F, 0.6F}) {
        render::View view = cloud(40);
        view.light.shadows = true;
        view.light.softness = softness;
        view.ambient.occlusion = 0.5F;
        render::View exact = view;
        exact.sphereObstacles.push_back({{0.1F, 0.8F, 2.0F}, 0.7F, {0.8F, 0.2F, 0.2F}});
        view.meshObstacles.push_back({meshSphere(0.7, 400), glm::mat3(1.0F), {0.1F, 0.8F, 2.0F}, {0.8F, 0.2F, 0.2F}});
        for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
            const Difference difference = compare(drawn(view, kSize, quality), drawn(exact, kSize, quality), 12);
            INFO("softness " << softness << ", quality " << int(quality) << ": " << difference);
            // The chords of 400 segments lie 1 - cos(pi/400) = 3e-5 of the radius inside: no pixel. The edges of the
            // shadow, which the sphere's soft edge widens with the distance and that of a mesh does not.
            CHECK(difference.share < (softness > 0.0F ? 0.05 : 0.012));
            CHECK(difference.mean < (softness > 0.0F ? 1.0 : 0.3));
        }
        view.light.shadows = exact.light.shadows = false;
        const Difference unshaded = compare(drawn(view, kSize, Quality::draft), drawn(exact, kSize, Quality::draft), 2);
        INFO(unshaded);
        CHECK(unshaded.share <= 8.0 / kPixels);  // on the outline, by rounding
    }
}

TEST_CASE("A box of twelve triangles looks like the exact one", "[meshes]") {
    render::View view = cloud(40);
    render::View exact = view;
    const glm::vec3 low{-0.5F, 0.011F, 1.2F};
    const glm::vec3 high{0.8F, 1.1F, 2.1F};
    exact.boxObstacles.push_back({low, high, {0.2F, 0.3F, 0.7F}});
    view.meshObstacles.push_back({meshBox(low, high), glm::mat3(1.0F), glm::vec3(0.0F), {0.2F, 0.3F, 0.7F}});
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
        const Difference difference =
            compare(drawn(view, kSize, quality), drawn(exact, kSize, quality), limitOf(quality));
        INFO("quality " << int(quality) << ": " << difference);
        CHECK(difference.share <= 6.0 / kPixels);  // on outlines, by rounding
    }
    view.light.shadows = exact.light.shadows = true;
    const Difference shaded = compare(drawn(view, kSize, Quality::normal), drawn(exact, kSize, Quality::normal), 12);
    INFO(shaded);
    CHECK(shaded.share < 0.012);  // on the edges of shadows
}

TEST_CASE("The eye in a bowl, within a solid, and close to large triangles", "[meshes]") {
    for (const int place : {0, 1, 2}) {
        render::View view = cloud(40);
        if (place == 0) view.meshObstacles.push_back({meshBowl(1.0, 0.1, 40), glm::mat3(1.0F), {2.0F, 3.0F, 5.1F}});
        if (place == 1) view.meshObstacles.push_back({meshSphere(1.5, 24), glm::mat3(1.0F), {2.0F, 3.0F, 5.0F}});
        if (place == 2) {
            view.camera.eye = {0.3F, 0.25F, 0.4F};
            view.meshObstacles.push_back({meshBox({-9.0F, -0.1F, -9.0F}, {9.0F, 0.01F, 9.0F})});
            view.meshObstacles.push_back({meshBox({-9.0F, 2.5F, -9.0F}, {9.0F, 3.0F, 9.0F})});
            view.meshObstacles.push_back({meshTorus(0.8, 0.1, 60), glm::mat3(1.0F), {0.3F, 0.25F, 0.4F}});
        }
        for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
            view.camera.projection = projection;
            view.camera.halfHeight = 1.1F;
            const Difference difference = differenceFromOracle(By::cpu, view, kSize, 1);
            INFO("place " << place << ", projection " << int(projection) << ": " << difference);
            CHECK(difference.share <= 10.0 / kPixels);  // on outlines, by rounding
        }
    }
}

TEST_CASE("No background shows through a mesh", "[meshes]") {
    for (int turn = 0; turn < 8; ++turn) {
        render::View view;
        view.background = {glm::vec3(1.0F), glm::vec3(1.0F)};
        view.light.color = glm::vec3(0.0F);
        view.ambient = {glm::vec3(0.0F), glm::vec3(0.0F)};
        view.camera.eye = {0.0F, 0.0F, 5.0F};
        const float angle = 0.37F * static_cast<float>(turn);
        // The sphere covers the picture, and its triangles are about as large as pixels.
        view.meshObstacles.push_back({meshSphere(3.0, 300), rotationAround({1.0F, 2.0F, 3.0F}, angle)});
        for (const Quality quality : {Quality::draft, Quality::normal}) {
            const render::Image image = drawn(view, {320, 180}, quality);
            CHECK(*std::max_element(image.rgb.begin(), image.rgb.end()) == 0);
        }
    }
}

TEST_CASE("A convex mesh does not shade itself", "[meshes]") {
    for (const float softness : {0.0F, 0.5F}) {
        for (const glm::vec3 toLight : {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.9F, 0.06F, -0.3F)}) {
            render::View view = cloud(1);
            view.ground.reset();
            view.particles[0].center = {0.0F, -9.0F, 0.0F};
            view.light.softness = softness;
            view.light.toLight = glm::normalize(toLight);
            view.meshObstacles.push_back({meshSphere(0.8, 200), glm::mat3(1.0F), {-0.3F, 0.9F, 0.0F}});
            const render::Image lit = drawn(view, kSize, Quality::normal);
            view.light.shadows = true;
            const Difference difference = compare(drawn(view, kSize, Quality::normal), lit, 2);
            INFO("softness " << softness << ": " << difference);
            CHECK(difference.share == 0.0);
        }
    }
}

TEST_CASE("A thin plate of narrow triangles does not shade itself", "[meshes]") {
    const glm::dvec2 up(0.0, 1.0);
    const glm::dvec2 outward(1.0, 0.0);
    const auto plate = turned({{{0.0, -0.02}, -up},
                               {{0.9, -0.02}, -up},
                               {{0.9, -0.02}, outward},
                               {{0.9, 0.02}, outward},
                               {{0.9, 0.02}, up},
                               {{0.0, 0.02}, up}},
                              false, 200);
    for (const float softness : {0.0F, 0.5F}) {
        render::View view = cloud(1);
        view.ground.reset();
        view.particles[0].center = {0.0F, -9.0F, 0.0F};
        view.light.softness = softness;
        view.light.toLight = glm::normalize(glm::vec3(-0.55F, 0.75F, 0.4F));
        view.meshObstacles.push_back({plate, glm::mat3(1.0F), {-0.3F, 0.9F, 0.0F}});
        const render::Image lit = drawn(view, kSize, Quality::normal);
        view.light.shadows = true;
        const Difference difference = compare(drawn(view, kSize, Quality::normal), lit, 2);
        INFO("softness " << softness << ": " << difference);
        CHECK(difference.share == 0.0);
    }
}

TEST_CASE("Lines run along faces of meshes as along those of boxes", "[meshes]") {
    render::View view = cloud(0);
    const glm::vec3 low{-0.5F, 0.21F, 1.0F};
    const glm::vec3 high{0.7F, 1.2F, 1.6F};
    view.edges.push_back({low, {high.x, low.y, low.z}});
    view.edges.push_back({{low.x, low.y, high.z}, high});
    view.edges.push_back({{-2.0F, 0.5F, 0.2F}, {2.0F, 0.6F, 0.2F}, {1.0F, 0.9F, 0.0F}, 24.0F});
    render::View exact = view;
    exact.boxObstacles.push_back({low, high});
    view.meshObstacles.push_back({meshBox(low, high)});
    for (const Quality quality : {Quality::draft, Quality::normal}) {
        const Difference difference =
            compare(drawn(view, kSize, quality), drawn(exact, kSize, quality), limitOf(quality));
        INFO("quality " << int(quality) << ": " << difference);
        CHECK(difference.share <= 6.0 / kPixels);
    }
}

TEST_CASE("Layers show meshes with depth, normal and alpha, and without an id", "[meshes]") {
    render::View view = cloudWithMeshes(60);
    for (std::uint32_t k = 0; k < view.particles.size(); ++k) view.particleIds.push_back(k);
    render::Layers layers;
    render::Renderer(kSize, Quality::normal).draw(view, {.color = true, .points = true, .ids = true}, layers);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.camera.target) - glm::dvec3(view.camera.eye));
    const oracle::Scene scene(view);
    int seen = 0;
    int wrong = 0;
    for (int k = 0; k < kSize.width * kSize.height; ++k) {
        const oracle::Ray ray = oracle::pixelRay(view, kSize, k % kSize.width + 0.5, k / kSize.width + 0.5);
        const oracle::Hit hit = oracle::trace(scene, ray);
        if (hit.kind != oracle::Hit::Kind::meshObstacle) continue;
        ++seen;
        const render::VisiblePoint& point = layers.points[static_cast<std::size_t>(k)];
        const double depth = hit.distance * glm::dot(ray.direction, forward);
        // Single precision, at grazing angles.
        const bool isNear = std::abs(double(point.depth) - depth) < 1e-4 * depth &&
                            glm::distance(glm::dvec3(point.normal), hit.normal) < 1e-2;
        const bool isMesh = layers.ids[static_cast<std::size_t>(k)] == 0;
        wrong += isNear && isMesh && layers.color[static_cast<std::size_t>(k)].w > 0.0F ? 0 : 1;
    }
    CHECK(seen > 1000);
    CHECK(wrong <= 6);  // on outlines, by rounding
}

TEST_CASE("The oracle's meshes are the closed forms", "[meshes]") {
    // Rays from all around at a box, of which the oracle knows the exact form as well.
    const render::BoxObstacle box{{-0.5F, -0.25F, -1.0F}, {0.75F, 0.5F, 1.0F}, glm::vec3(0.5F)};
    render::View exact;
    exact.boxObstacles.push_back(box);
    render::View view;
    view.meshObstacles.push_back({meshBox(box.minimum, box.maximum)});
    const oracle::Scene scene(view);
    std::mt19937 random(5);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    int hits = 0;
    for (int k = 0; k < 2000; ++k) {
        const glm::dvec3 from = 5.0 * glm::normalize(glm::dvec3(uniform(), uniform(), uniform()));
        const glm::dvec3 to(uniform(), uniform(), 2.0 * uniform());
        const oracle::Ray ray{from, glm::normalize(to - from)};
        const oracle::Hit onMesh = oracle::trace(scene, ray);
        const oracle::Hit onBox = oracle::trace(exact, ray);
        const bool isHit = onBox.kind != oracle::Hit::Kind::none;
        REQUIRE((onMesh.kind != oracle::Hit::Kind::none) == isHit);
        if (!isHit) continue;
        ++hits;
        CHECK(onMesh.distance == Approx(onBox.distance).epsilon(1e-12));  // some roundings
        CHECK(glm::distance(onMesh.normal, onBox.normal) < 1e-12);
    }
    CHECK(hits > 500);
}
