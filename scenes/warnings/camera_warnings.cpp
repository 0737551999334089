// Looks for anything of the scene in the camera's picture: particles where they start and where they fly from there,
// points of emission, and what is drawn of the obstacles. The ground does not count.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/neighbors/pair_estimate.h"
#include "scenes/warnings/start_findings.h"

namespace scenes {
namespace {

using engine::Vec3;

/// Number of moments at which the picture is examined, evenly over the animation. Chosen: a fast camera path crosses a
/// scene in no less than a tenth of its time.
constexpr int kMoments = 17;

/// Most particles of each body or emitter whose flight is followed. Chosen: they take no time, and a body is not so
/// large that none of so many would fly into the picture.
constexpr std::size_t kMostFollowed = 256;

/// The room that a camera sees, as half-spaces: a point is in the picture where offset + normal * point >= 0 for each.
class Sight {
 public:
    Sight(const CameraPlacement& camera, const render::PictureSize& size) : eye_(camera.eye) {
        const Vec3 forward = (camera.target - camera.eye).normalized();
        const Vec3 right = forward.cross(camera.up).normalized();
        const Vec3 up = right.cross(forward);
        const double aspect = static_cast<double>(size.width) / size.height;
        const bool isPerspective = camera.projection == render::Projection::perspective;
        const double halfHeight = isPerspective ? std::tan(0.5 * camera.verticalFov) : camera.halfHeight;
        std::size_t side = 0;
        sides_[side++] = {forward, 0.0};
        for (const auto& [axis, half] : {std::pair{right, aspect * halfHeight}, std::pair{up, halfHeight}})
            for (const double sign : {1.0, -1.0}) {
                const Vec3 normal = isPerspective ? Vec3(half * forward + sign * axis) : Vec3(sign * axis);
                const double length = normal.norm();
                sides_[side++] = {normal / length, isPerspective ? 0.0 : half};
            }
    }

    /// Whether any of a ball may be in the picture.
    bool mayShow(const Vec3& center, double radius) const {
        return std::ranges::all_of(
            sides_, [&](const Side& side) { return engine::dot(center - eye_, side.normal) + side.offset > -radius; });
    }

    /// Whether any of a box may be in the picture.
    bool mayShow(const engine::BoundingBox& box) const {
        return std::ranges::all_of(sides_, [&](const Side& side) {
            Vec3 corner;  // the one farthest along the normal
            for (int axis = 0; axis < 3; ++axis)
                corner[axis] = side.normal[axis] > 0.0 ? box.high[axis] : box.low[axis];
            return engine::dot(corner - eye_, side.normal) + side.offset > 0.0;
        });
    }

 private:
    struct Side {
        Vec3 normal = Vec3::UnitX();
        double offset = 0.0;  ///< m
    };
    Vec3 eye_;
    std::array<Side, 5> sides_;
};

/// Whether any of the obstacles of which surfaces are drawn may be in the picture at the start.
bool showsObstacle(const Sight& sight, const Scene& scene) {
    const engine::Obstacles& obstacles = scene.setup.obstacles;
    const auto mayShow = [&](const auto& drawn) {
        const engine::BoundingBox bounds = *engine::boundsOf(obstacles.shapes[drawn.obstacle]);
        return sight.mayShow(engine::isPlaced(obstacles, drawn.obstacle)
                                 ? engine::boundsIn(engine::poseAt(obstacles.motions[drawn.obstacle], 0.0), bounds)
                                 : bounds);
    };
    const Look& look = scene.look;
    return std::ranges::any_of(look.boxes, mayShow) || std::ranges::any_of(look.spheres, mayShow) ||
           std::ranges::any_of(look.solids, mayShow);
}

bool showsStart(const Sight& sight, const Scene& scene) {
    const engine::Particles& particles = scene.setup.initial;
    for (std::size_t p = 0; p < particles.count(); ++p)
        if (sight.mayShow(particles.position[p], particles.radius[p])) return true;
    return std::ranges::any_of(scene.setup.emitters, [&](const engine::Emitter& emitter) {
        const double radius = scene.setup.materials[emitter.material].radius;
        return std::ranges::any_of(emitter.sites, [&](const Vec3& site) {
            return sight.mayShow(engine::launchAt(emitter, emitter.start, {site, Vec3::Zero()}).position, radius);
        });
    });
}

/// A particle that flies freely from where it starts.
struct Flight {
    Vec3 start = Vec3::Zero();     ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double radius = 0.1;           ///< m
};

/// Times at which flights from an emitter are followed, s: several, if it is in motion.
std::vector<double> momentsOf(const engine::Emitter& emitter, double duration) {
    if (emitter.motion.isAtRest()) return {emitter.start};
    std::vector<double> moments;
    const double end = std::min(duration, emitter.until);
    for (int k = 0; k < kMoments; ++k) moments.push_back(emitter.start + (end - emitter.start) * k / (kMoments - 1));
    return moments;
}

std::vector<Flight> flightsOf(const Scene& scene) {
    std::vector<Flight> flights;
    const auto sampleOf = [](std::size_t count) {
        return engine::sampleOf(count, engine::strideFor(static_cast<double>(count), kMostFollowed));
    };
    const engine::Particles& particles = scene.setup.initial;
    for (const std::uint32_t p : sampleOf(particles.count()))
        flights.push_back({particles.position[p], particles.velocity[p], particles.radius[p]});
    for (const engine::Emitter& emitter : scene.setup.emitters)
        for (const double moment : momentsOf(emitter, scene.duration))
            for (const std::uint32_t s : sampleOf(emitter.sites.size())) {
                const auto [start, velocity] = engine::launchAt(emitter, moment, {emitter.sites[s], emitter.velocity});
                flights.push_back({start, velocity, scene.setup.materials[emitter.material].radius});
            }
    return flights;
}

/// Whether a particle that has flown for any time up to `seconds` may be in the picture.
bool showsFlight(const Sight& sight, const Scene& scene, const Flight& flight, double seconds) {
    for (int k = 1; k < kMoments; ++k) {
        const double time = seconds * k / (kMoments - 1);
        const Vec3 place = flight.start + time * flight.velocity + 0.5 * time * time * scene.setup.gravity;
        if (sight.mayShow(place, flight.radius)) return true;
    }
    return false;
}

bool showsAnything(const Scene& scene) {
    const std::vector<Flight> flights = flightsOf(scene);
    for (int k = 0; k < kMoments; ++k) {
        const double time = scene.duration * k / (kMoments - 1);
        const Sight sight(cameraAt(scene.camera, time), scene.size);
        if (showsObstacle(sight, scene) || showsStart(sight, scene)) return true;
        if (std::ranges::any_of(flights, [&](const Flight& each) { return showsFlight(sight, scene, each, time); }))
            return true;
    }
    return false;
}

}  // namespace

void findEmptyPicture(const Scene& scene, StartMessages& messages) {
    if (showsAnything(scene)) return;
    const engine::Particles& particles = scene.setup.initial;
    const Vec3 start = particles.count() > 0          ? particles.position.front()
                       : scene.setup.emitters.empty() ? Vec3(Vec3::Zero())
                                                      : scene.setup.emitters.front().sites.front();
    messages.add(scene.tables.camera,
                 "the camera sees nothing of the scene but the ground, at any time; turn its target to what happens, "
                 "e.g. at " +
                     positionText(start));
    messages.endKind();
}

}  // namespace scenes
