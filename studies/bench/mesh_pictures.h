// What a mesh obstacle adds to the time of a picture. Called by bench.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/bench/bench.h"

namespace studies {

/// The material of these measurements.
inline constexpr const char* kMeshPicture = "torus";

/// The numbers of triangles of the pictures that are measured. Without any, the picture has nothing but its particles
/// and the ground.
std::vector<std::size_t> meshSizes();

/// The name of the measurement of a picture with so many triangles.
std::string meshPictureName(std::size_t triangles);

/// Measures drawing a picture of 1280 x 720 pixels with shadows on the CPU, of particles in the hole of a torus that is
/// as wide as the picture is high. The hash is that of the picture's pixels.
BenchRow meshPictureRow(std::size_t triangles, const BenchSettings& settings);

}  // namespace studies
