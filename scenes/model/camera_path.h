// Where the camera is at a given time: fixed, or interpolated between the keys of a path.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/model/look.h"

namespace scenes {

struct CameraKey {
    double time = 0.0;  ///< s
    CameraPlacement placement;
};

/// A fixed camera (one key), or the path of a moving one. There is at least one key, the times of the keys increase,
/// and all have the same projection.
using CameraPath = std::vector<CameraKey>;

/// Where the camera is at a time in s. Before the first key of the path it is placed as at that key, after the last as
/// at the last. Between two keys every coordinate of eye, target and up, the angle of view, the half height, and the
/// numbers of lens and shutter follow a monotone cubic: values and first derivatives are continuous, no value leaves
/// the interval between its values at the two keys, and the derivatives vanish at the first and the last key. Fritsch
/// and Butland 1984, A Method for Constructing Local Monotone Piecewise Cubic Interpolants.
CameraPlacement cameraAt(const CameraPath& path, double time);

/// Half the height of what the picture shows at the distance of the camera's target, m.
double halfHeightAtTarget(const CameraPlacement& camera);

/// A moment between two keys of a path at which the picture jumps, although both keys are sound.
struct CameraJump {
    enum class Cause { throughTarget, alongUp };
    std::size_t laterKey = 0;  ///< of the two keys
    double time = 0.0;         ///< s
    Cause cause = Cause::throughTarget;
};

/// The jumps of a path, at most one for each pair of keys: the eye passes through the target, so that the camera looks
/// back at once; or the camera looks along its up direction, so that the picture turns over.
std::vector<CameraJump> jumpsOf(const CameraPath& path);

}  // namespace scenes
