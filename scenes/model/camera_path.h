// Where the camera is at a moment: it stands still, or glides along the keys of a path.
#pragma once

#include <vector>

#include "scenes/model/look.h"

namespace scenes {

struct CameraKey {
    double time = 0.0;  ///< s
    CameraPlacement placement;
};

/// Holds:  at least one key; times increase; all keys have one projection.
struct CameraPath {
    std::vector<CameraKey> keys;
};

/// The placement at a time in s: that of a key at its time, of the first before and of the last after all keys; between
/// two keys every coordinate of eye, target and up, the angle of view and the half height run through a monotone cubic.
/// Holds:  all of them and their rates of change are continuous, and none leaves the interval between its values at the
///         two keys around it; at the first and the last key the rates are zero.
/// Source: Fritsch and Butland 1984, A Method for Constructing Local Monotone Piecewise Cubic Interpolants.
CameraPlacement cameraAt(const CameraPath& path, double time);

}  // namespace scenes
