// The torus has five times as many segments around its axis as around its tube, so that its triangles are about as wide
// as long.
#include "studies/bench/mesh_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/hash.h"
#include "render/picture/view.h"
#include "render/renderer.h"
#include "studies/common/timing.h"

namespace studies {
namespace {

constexpr double kRing = 1.0;  // distance of the tube's middle from the axis, m
constexpr double kTube = 0.4;  // radius of the tube, m

std::shared_ptr<const render::SolidMesh> torus(std::size_t triangles) {
    auto mesh = std::make_shared<render::SolidMesh>();
    const auto tubes = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 10.0)));
    const std::uint32_t rings = 5 * tubes;
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        const double turn = 2.0 * std::numbers::pi * ring / rings;
        for (std::uint32_t tube = 0; tube < tubes; ++tube) {
            const double angle = 2.0 * std::numbers::pi * tube / tubes;
            const auto around = [&](double distance, double height) {
                return glm::vec3(glm::dvec3(distance * std::cos(turn), height, -distance * std::sin(turn)));
            };
            mesh->normals.push_back(around(std::cos(angle), std::sin(angle)));
            mesh->positions.push_back(around(kRing + kTube * std::cos(angle), kTube * std::sin(angle)));
            const std::uint32_t next = (ring + 1) % rings * tubes;
            const std::uint32_t above = (tube + 1) % tubes;
            mesh->triangles.push_back({ring * tubes + tube, next + tube, next + above});
            mesh->triangles.push_back({ring * tubes + tube, next + above, ring * tubes + above});
        }
    }
    return mesh;
}

render::View viewOf(std::size_t triangles) {
    render::View view;
    for (int k = 0; k < 27; ++k) {
        const glm::vec3 at(k % 3 - 1, k / 3 % 3, k / 9 - 1);
        view.particles.push_back({glm::vec3(0.0F, 0.3F, 0.0F) + 0.2F * at, 0.1F, {0.2F, 0.5F, 0.8F}});
    }
    view.camera.eye = {1.5F, 2.4F, 3.0F};
    view.camera.target = {0.0F, 0.4F, 0.0F};
    view.light.softness = 0.3F;
    view.ground = render::Ground{};
    if (triangles > 0)
        view.meshObstacles.push_back({torus(triangles), glm::mat3(1.0F), {0.0F, 0.5F, 0.0F}, {0.8F, 0.6F, 0.3F}});
    return view;
}

/// Sinks the mesh from one picture to the next, and raises it again.
void move(render::View& view) {
    render::MeshObstacle& mesh = view.meshObstacles.front();
    mesh.position.y = mesh.position.y == 0.5F ? 0.49F : 0.5F;
}

}  // namespace

std::vector<MeshPicture> meshPictures() {
    return {{0}, {1000}, {100000}, {100000, true}};
}

std::string nameOf(const MeshPicture& picture) {
    return fmt::format("{} {} triangles", picture.isMoving ? "move" : "draw", picture.triangles);
}

BenchRow meshPictureRow(const MeshPicture& picture, const BenchSettings& settings) {
    const render::View first = viewOf(picture.triangles);
    render::View view = first;
    render::Renderer renderer({1280, 720}, render::Quality::normal);
    render::Image image = renderer.draw(view);  // allocates memory
    const auto drawNext = [&] {
        if (picture.isMoving) move(view);
        return secondsOf([&] { image = renderer.draw(view); });
    };
    const auto repeats = static_cast<int>(std::max(1.0, settings.secondsPerRound / drawNext()));
    std::vector<double> seconds;
    for (int round = 0; round < settings.rounds * repeats; ++round) seconds.push_back(drawNext());
    BenchRow row;
    row.name = nameOf(picture);
    row.material = kMeshPicture;
    row.particles = view.particles.size();
    row.precision = engine::Precision::singles;
    row.seconds = median(std::move(seconds));
    row.stateHash = engine::hexadecimal(engine::fnv1aOf(renderer.draw(first).rgb));
    return row;
}

}  // namespace studies
