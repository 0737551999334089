// Where the camera is at a given time: fixed, or interpolated between the keys of a path.
#pragma once

#include <vector>

#include "scenes/model/look.h"

namespace scenes {

struct CameraKey {
    double time = 0.0;  ///< s
    CameraPlacement placement;
};

/// A fixed camera (one key), or a path that it moves along. There is at least one key, times increase, and all keys
/// have the same projection.
struct CameraPath {
    std::vector<CameraKey> keys;
};

/// The placement at a time in s: that of a key at the key's time, of the first key before it and of the last key after
/// it. Between two keys every coordinate of eye, target and up, the angle of view and the half height follow a monotone
/// cubic: values and first derivatives are continuous, no value leaves the interval between those of the adjacent keys,
/// and the derivatives vanish at the first and the last key.
/// Fritsch and Butland 1984, A Method for Constructing Local Monotone Piecewise Cubic Interpolants.
CameraPlacement cameraAt(const CameraPath& path, double time);

}  // namespace scenes
