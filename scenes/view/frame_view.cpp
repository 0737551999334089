// Everything that all frames of an animation have in common has been built together with the scene. What is added here
// changes from frame to frame: the camera, the particles with their colors, the time stamp, and the point that all
// positions are relative to.
//
// The shutter opens half of its time before a frame's own moment and closes as long after it, as in Blender and most
// other renderers, so that a blurred thing lies around the place where a sharp picture of the same frame has it, and a
// film that loops still does. Obstacles and cameras are where their motions take them at each moment, before the first
// frame too. Of the particles the state of the frame alone is known: each keeps its velocity while the shutter is open,
// which is wrong by half its acceleration times the square of half that time: 0.3 mm in free fall at 30 frames a second
// with a shutter of 0.5. One that meets a wall meanwhile is drawn a little way into it. Those that are born or removed
// while the shutter is open are drawn at all of its moments or at none, as in the sharp picture.
#include "scenes/view/frame_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/heat/heat_exchange.h"
#include "scenes/model/to_float.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

using engine::Vec3;

Vec3 particleColor(const Scene& scene, const engine::Particles& particles, std::size_t index, double time) {
    const Look& look = scene.look;
    const Vec3& own = scene.materialColors.at(particles.material[index]);
    if (look.colorBy == ColorBy::material) return own;
    const double quantity = look.colorBy == ColorBy::age ? time - particles.birthTime[index]
                            : look.colorBy == ColorBy::temperature
                                ? engine::temperatureOf(scene.setup.materials, particles, index)
                                : std::sqrt(engine::squaredLength(particles.velocity[index]));
    const Vec3 color = rampColor(look.ramp, (quantity - look.rampLow) / (look.rampHigh - look.rampLow));
    if (!look.isRampOfLight) return color;
    // A glowing particle radiates the square of its color, and lights add up.
    return (own.cwiseAbs2() + color.cwiseAbs2()).cwiseSqrt().cwiseMin(1.0);
}

/// The point that the positions of a view are relative to, so that single precision is fine enough for them wherever
/// the scene lies. It is the point nearest to the camera's target of a lattice whose points are at least 256 times as
/// far apart as half the height of the picture: the origin in most scenes, and the same for all frames while the camera
/// does not travel far. A float is then off by at most 2^-16 of half that height, 1/170 of a pixel of a picture with
/// 768 rows.
Vec3 originOf(const CameraPlacement& camera) {
    int exponent = 0;
    std::frexp(halfHeightAtTarget(camera), &exponent);
    const double spacing = std::ldexp(256.0, exponent);
    Vec3 origin;
    for (int axis = 0; axis < 3; ++axis) origin[axis] = spacing * std::round(camera.target[axis] / spacing);
    return origin;
}

render::Camera cameraOf(const CameraPlacement& placement, const Vec3& origin) {
    return {.projection = placement.projection,
            .eye = toFloat(placement.eye - origin),
            .target = toFloat(placement.target - origin),
            .up = toFloat(placement.up),
            .verticalFov = toFloat(placement.verticalFov),
            .halfHeight = toFloat(placement.halfHeight),
            .aperture = toFloat(placement.aperture),
            .focus = toFloat(placement.focus)};
}

/// Where the obstacles of a scene are at a time, relative to the origin of a view.
struct ObstaclePlaces {
    const engine::Obstacles& obstacles;
    double time;
    const Vec3& origin;

    /// Whether an obstacle, given by its index, is still there.
    bool isThere(std::size_t obstacle) const {
        return obstacles.motions.empty() || time < obstacles.motions[obstacle].until;
    }

    engine::Pose pose(std::size_t obstacle) const {
        return engine::isPlaced(obstacles, obstacle) ? engine::poseAt(obstacles.motions[obstacle], time)
                                                     : engine::Pose{};
    }

    glm::vec3 inView(const engine::Pose& pose, const Vec3& point) const {
        return toFloat(pose.toScene(point) - origin);
    }
};

glm::mat3 matrixInFloat(const engine::Matrix3& matrix) {
    glm::mat3 rotation;
    for (int column = 0; column < 3; ++column) rotation[column] = toFloat(Vec3(matrix.col(column)));
    return rotation;
}

/// Adds what is drawn of the obstacles.
/// @param picture  a view, or one of its moments
template <class Picture>
void addObstacles(const Look& look, const ObstaclePlaces& places, Picture& picture) {
    for (const DrawnSphere& sphere : look.spheres)
        if (places.isThere(sphere.obstacle))
            picture.sphereObstacles.push_back(
                {places.inView(places.pose(sphere.obstacle), sphere.center), toFloat(sphere.radius), sphere.color});
    for (const DrawnBox& box : look.boxes)
        if (places.isThere(box.obstacle))
            picture.boxObstacles.push_back(
                {toFloat(Vec3(box.minimum - places.origin)), toFloat(Vec3(box.maximum - places.origin)), box.color});
    for (const DrawnSolid& solid : look.solids) {
        if (!places.isThere(solid.obstacle)) continue;
        const engine::Pose pose = places.pose(solid.obstacle);
        picture.meshObstacles.push_back(
            {solid.mesh, matrixInFloat(pose.rotation), places.inView(pose, solid.origin), solid.color, solid.medium});
    }
    for (const DrawnEdges& edges : look.edges) {
        if (!places.isThere(edges.obstacle)) continue;
        const engine::Pose pose = places.pose(edges.obstacle);
        for (const auto& [from, to] : edges.lines)
            picture.edges.push_back({places.inView(pose, from), places.inView(pose, to), edges.color, look.edgeWidth});
    }
}

/// Whether anything of a scene moves at a moment of its simulation.
bool isInMotion(const Scene& scene, const engine::Particles& particles) {
    const auto isMoving = [](const Vec3& velocity) { return velocity != Vec3::Zero(); };
    return scene.camera.size() > 1 || engine::areInMotion(scene.setup.obstacles) ||
           std::ranges::any_of(particles.velocity, isMoving);
}

/// What moves while the shutter is open around a moment of the simulation; nothing where it is not open, and where
/// nothing moves.
std::optional<render::Shutter> shutterOf(const Scene& scene, const engine::Simulation& simulation, double open,
                                         const Vec3& origin) {
    const engine::Particles& particles = simulation.particles;
    if (open == 0.0 || !isInMotion(scene, particles)) return std::nullopt;
    const int perAxis = scene.look.common.samplesPerAxis;
    render::Shutter shutter;
    for (int sample = 0; sample < perAxis * perAxis; ++sample) {
        const double after = open * render::sampleTime(sample, perAxis);
        const double time = simulation.time + after;
        render::Moment& moment = shutter.moments.emplace_back();
        moment.time = toFloat(after);
        moment.camera = cameraOf(cameraAt(scene.camera, time), origin);
        addObstacles(scene.look, {scene.setup.obstacles, time, origin}, moment);
    }
    shutter.velocities.reserve(particles.count());
    for (const Vec3& velocity : particles.velocity) shutter.velocities.push_back(toFloat(velocity));
    return shutter;
}

}  // namespace

void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame) {
    // The time of a frame is its index / fps, so the index of the current frame follows from the time.
    const int current = static_cast<int>(std::lround(scene.fps.framesIn(simulation.time)));
    for (int next = current + 1; next <= frame; ++next) engine::advance(simulation, frameTime(scene, next));
}

std::string timeText(const Scene& scene, double time) {
    // Frames are 1/fps apart: two decimals distinguish their times up to 100 frames per second.
    return fmt::format("t = {:.{}f} s", time, scene.fps.framesIn(1.0) > 100.0 ? 3 : 2);
}

Vec3 viewOrigin(const Scene& scene, double time) {
    return originOf(cameraAt(scene.camera, time));
}

std::vector<render::Sphere> drawnParticles(const Scene& scene, const engine::Simulation& simulation,
                                           const Vec3& origin) {
    const engine::Particles& particles = simulation.particles;
    std::vector<render::Sphere> drawn;
    drawn.reserve(particles.count());
    for (std::size_t index = 0; index < particles.count(); ++index)
        drawn.push_back({toFloat(particles.position[index] - origin), toFloat(particles.radius[index]),
                         toFloat(particleColor(scene, particles, index, simulation.time))});
    return drawn;
}

render::View frameView(const Scene& scene, const engine::Simulation& simulation) {
    const double time = simulation.time;
    render::View view = scene.look.common;
    const CameraPlacement camera = cameraAt(scene.camera, time);
    const Vec3 origin = originOf(camera);
    view.camera = cameraOf(camera, origin);
    if (view.ground) {
        view.ground->height = toFloat(scene.look.groundHeight - origin.y());
        // The ground fades with the distance from the point below the camera's target.
        view.ground->center = {view.camera.target.x, view.ground->height, view.camera.target.z};
    }
    addObstacles(scene.look, {scene.setup.obstacles, time, origin}, view);
    if (scene.look.hasTimeStamp) view.overlay.stamp = timeText(scene, time);
    view.particles = drawnParticles(scene, simulation, origin);
    view.shutter = shutterOf(scene, simulation, camera.shutter * scene.fps.timeOf(1), origin);
    return view;
}

double depthRange(const Scene& scene) {
    double farthest = 0.0;
    for (const CameraKey& key : scene.camera)
        farthest = std::max(farthest, std::sqrt(engine::squaredLength(key.placement.target - key.placement.eye)));
    return 4.0 * farthest;
}

}  // namespace scenes
