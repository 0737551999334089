// The numbers that place a camera, and where its path jumps.
#include "scenes/model/camera_path.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "engine/core/monotone_cubic.h"

namespace scenes {
namespace {

using engine::Vec3;

/// The numbers that place a camera: coordinates of eye, target and up, angle of view, half height, lens and shutter.
constexpr std::size_t kNumbers = 14;
using Numbers = std::array<double, kNumbers>;

Numbers numbersOf(const CameraPlacement& camera) {
    return {camera.eye.x(),    camera.eye.y(),  camera.eye.z(), camera.target.x(), camera.target.y(),
            camera.target.z(), camera.up.x(),   camera.up.y(),  camera.up.z(),     camera.verticalFov,
            camera.halfHeight, camera.aperture, camera.focus,   camera.shutter};
}

CameraPlacement placementOf(const Numbers& numbers, render::Projection projection) {
    return {.projection = projection,
            .eye = Vec3(numbers[0], numbers[1], numbers[2]),
            .target = Vec3(numbers[3], numbers[4], numbers[5]),
            .up = Vec3(numbers[6], numbers[7], numbers[8]),
            .verticalFov = numbers[9],
            .halfHeight = numbers[10],
            .aperture = numbers[11],
            .focus = numbers[12],
            .shutter = numbers[13]};
}

/// Whether a direction turns by 60 degrees or more between two moments of a path that are close together.
bool turnsAtOnce(const Vec3& before, const Vec3& now) {
    return before.dot(now) <= 0.5 * before.norm() * now.norm();
}

}  // namespace

CameraPlacement cameraAt(const CameraPath& path, double time) {
    const auto timeOf = [&](std::size_t key) { return path[key].time; };
    const auto valuesOf = [&](std::size_t key) { return numbersOf(path[key].placement); };
    const auto point = engine::pathAt<kNumbers>(path.size(), time, timeOf, valuesOf);
    return placementOf(point.values, path.front().placement.projection);
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
