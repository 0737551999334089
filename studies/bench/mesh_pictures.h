// What a mesh obstacle adds to the time of a picture. Called by bench.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/bench/bench.h"

namespace studies {

/// The material of these measurements.
inline constexpr const char* kMeshPicture = "torus";

/// A picture that is measured. Without triangles it has nothing but its particles and the ground.
struct MeshPicture {
    std::size_t triangles = 0;
    bool isMoving = false;  ///< whether the mesh moves from one picture to the next, so that nothing of it can be kept
};

std::vector<MeshPicture> meshPictures();

/// The name of the measurement of a picture.
std::string nameOf(const MeshPicture& picture);

/// Measures drawing a picture of 1280 x 720 pixels with shadows on the CPU, of particles in the hole of a torus that is
/// as wide as the picture is high. The hash is that of the pixels of the first picture, which is drawn again after the
/// others.
BenchRow meshPictureRow(const MeshPicture& picture, const BenchSettings& settings);

}  // namespace studies
