// Monotone piecewise cubic interpolation (PCHIP). A natural spline would be smoother in its second derivative, but
// overshoots its keys: a camera would dip into the ground, or drift where two equal keys are meant to hold it still.
#include "scenes/model/camera_path.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace scenes {
namespace {

using engine::Vec3;

/// The numbers that place a camera: coordinates of eye, target and up, angle of view and half height.
using Numbers = std::array<double, 11>;

Numbers numbersOf(const CameraPlacement& camera) {
    return {camera.eye.x(), camera.eye.y(), camera.eye.z(), camera.target.x(),  camera.target.y(), camera.target.z(),
            camera.up.x(),  camera.up.y(),  camera.up.z(),  camera.verticalFov, camera.halfHeight};
}

CameraPlacement placementOf(const Numbers& numbers, render::Projection projection) {
    return {.projection = projection,
            .eye = Vec3(numbers[0], numbers[1], numbers[2]),
            .target = Vec3(numbers[3], numbers[4], numbers[5]),
            .up = Vec3(numbers[6], numbers[7], numbers[8]),
            .verticalFov = numbers[9],
            .halfHeight = numbers[10]};
}

/// Time derivatives of a camera's numbers at a key of its path (per second): zero at the ends of the path, where the
/// camera is at rest, and for a number that has an extremum at the key; otherwise the weighted harmonic mean of the
/// slopes to the keys before and after. The mean is at most three times the smaller slope, which keeps the cubics on
/// both sides monotone.
Numbers slopesAt(const CameraPath& path, std::size_t key) {
    Numbers slopes{};
    if (key == 0 || key + 1 == path.size()) return slopes;
    const double before = path[key].time - path[key - 1].time;
    const double after = path[key + 1].time - path[key].time;
    const Numbers from = numbersOf(path[key - 1].placement);
    const Numbers here = numbersOf(path[key].placement);
    const Numbers to = numbersOf(path[key + 1].placement);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        const double left = (here[k] - from[k]) / before;
        const double right = (to[k] - here[k]) / after;
        const double leftWeight = before + 2.0 * after;
        const double rightWeight = after + 2.0 * before;
        // Each slope is compared with zero by itself, because the product of two small slopes may underflow.
        if ((left > 0.0 && right > 0.0) || (left < 0.0 && right < 0.0))
            slopes[k] = (leftWeight + rightWeight) / (leftWeight / left + rightWeight / right);
    }
    return slopes;
}

/// Whether a direction turns by 60 degrees or more between two moments of a path that are close together.
bool turnsAtOnce(const Vec3& before, const Vec3& now) {
    return before.dot(now) <= 0.5 * before.norm() * now.norm();
}

}  // namespace

CameraPlacement cameraAt(const CameraPath& path, double time) {
    const auto next =
        std::upper_bound(path.begin(), path.end(), time, [](double t, const CameraKey& key) { return t < key.time; });
    if (next == path.begin()) return path.front().placement;
    if (next == path.end()) return path.back().placement;
    const auto index = static_cast<std::size_t>(next - path.begin());
    const double length = next->time - path[index - 1].time;
    const double u = (time - path[index - 1].time) / length;
    const Numbers from = numbersOf(path[index - 1].placement);
    const Numbers to = numbersOf(next->placement);
    const Numbers slopesFrom = slopesAt(path, index - 1);
    const Numbers slopesTo = slopesAt(path, index);
    Numbers now{};
    // The Hermite cubic, written such that a number which is the same at both keys keeps its bits.
    for (std::size_t k = 0; k < now.size(); ++k)
        now[k] = from[k] + (to[k] - from[k]) * (u * u * (3.0 - 2.0 * u)) +
                 length * u * (1.0 - u) * ((1.0 - u) * slopesFrom[k] - u * slopesTo[k]);
    return placementOf(now, next->placement.projection);
}

double halfHeightAtTarget(const CameraPlacement& camera) {
    if (camera.projection == render::Projection::orthographic) return camera.halfHeight;
    return std::tan(0.5 * camera.verticalFov) * std::sqrt(engine::squaredLength(camera.target - camera.eye));
}

std::vector<CameraJump> jumpsOf(const CameraPath& path) {
    // Chosen: more moments than a film of a few seconds has frames between two keys.
    constexpr int kMoments = 256;
    std::vector<CameraJump> jumps;
    for (std::size_t key = 1; key < path.size(); ++key) {
        CameraPlacement before = path[key - 1].placement;
        for (int moment = 1; moment <= kMoments; ++moment) {
            const double share = static_cast<double>(moment) / kMoments;
            const double time = path[key - 1].time + share * (path[key].time - path[key - 1].time);
            const CameraPlacement now = cameraAt(path, time);
            const Vec3 ahead = now.target - now.eye;
            const Vec3 aheadBefore = before.target - before.eye;
            const bool isThroughTarget = turnsAtOnce(aheadBefore, ahead);
            const bool isAlongUp = turnsAtOnce(aheadBefore.cross(before.up), ahead.cross(now.up));
            if (isThroughTarget || isAlongUp) {
                jumps.push_back(
                    {key, time, isThroughTarget ? CameraJump::Cause::throughTarget : CameraJump::Cause::alongUp});
                break;
            }
            before = now;
        }
    }
    return jumps;
}

}  // namespace scenes
