// Compares the particles with the box in which the scene takes place.
#include "engine/run/strays.h"

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/core/parallel.h"
#include "engine/state/probe.h"

namespace engine {
namespace {

/// Distance from the scene's place, in diagonals of its box, beyond which particles count as strays. Chosen: far
/// outside any picture that shows the scene.
constexpr double kFarDiagonals = 4.0;

/// The times at which the sites of an emitter are looked at, s: its start, its keys, and now.
std::vector<double> momentsOf(const Emitter& emitter, double now) {
    std::vector<double> moments = {emitter.start};
    if (emitter.motion.isIdentity()) return moments;
    for (const PoseKey& key : emitter.motion.keys) moments.push_back(key.time);
    moments.push_back(now);
    return moments;
}

/// The box around everything that the scene begins with, with the way that emitters in motion have come until now (s),
/// and the points of planes nearest to it; none if it begins with nothing.
std::optional<BoundingBox> placeOf(const Setup& setup, double now) {
    std::optional<BoundingBox> place;
    const auto include = [&](const BoundingBox& box) {
        if (!place) place = box;
        place->include(box);
    };
    for (std::size_t p = 0; p < setup.initial.count(); ++p) {
        const Vec3 half = Vec3::Constant(setup.initial.radius[p]);
        include({setup.initial.position[p] - half, setup.initial.position[p] + half});
    }
    for (const Emitter& emitter : setup.emitters)
        for (const double moment : momentsOf(emitter, now))
            for (const Vec3& site : emitter.sites) {
                const Vec3 half = Vec3::Constant(setup.materials[emitter.material].radius);
                const Vec3 position = launchAt(emitter, moment, {site, Vec3::Zero()}).position;
                include({position - half, position + half});
            }
    for (const Obstacle& obstacle : setup.obstacles.shapes)
        if (const auto box = boundsOf(obstacle)) include(*box);
    if (!place) return place;
    // A floor far below belongs to the place, too.
    const Vec3 middle = place->middle();
    for (const Obstacle& obstacle : setup.obstacles.shapes)
        if (const auto* plane = std::get_if<Plane>(&obstacle)) {
            const Vec3 foot = middle - dot(middle - plane->point, plane->normal) * plane->normal;
            include({foot, foot});
        }
    return place;
}

}  // namespace

std::uint64_t strayCount(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const Setup& setup = simulation.setup;
    const std::optional<BoundingBox> place = placeOf(setup, simulation.time);
    if (!place) return 0;
    const double far = kFarDiagonals * (place->high - place->low).norm();
    return sumOver<std::uint64_t>(particles.count(), [&](std::size_t p) -> std::uint64_t {
        const Vec3& x = particles.position[p];
        const Vec3& v = particles.velocity[p];
        const Vec3 away = x - x.cwiseMax(place->low).cwiseMin(place->high);
        if (!(squaredLength(away) > far * far && dot(v, away) > 0.0 && dot(v, setup.gravity) >= 0.0)) return 0;
        return sumContacts(setup.obstacles, probeOf(setup.materials, particles, p, v, simulation.time)).energy != 0.0
                   ? 0
                   : 1;
    });
}

}  // namespace engine
