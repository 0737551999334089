// Bytes of a file that the user named. Used for scene files and for the particle files they name.
#pragma once

#include <cstddef>
#include <string>

namespace scenes {

/// Larger scene files are no scene files, bytes.
inline constexpr std::size_t kMaxSceneFileBytes = std::size_t{16} << 20U;

/// Room for some 50 million particles, bytes.
inline constexpr std::size_t kMaxParticleFileBytes = std::size_t{4} << 30U;

/// All bytes of a file. Throws: InputError if it cannot be read or is larger than the limit.
std::string readFile(const std::string& path, std::size_t limit);

}  // namespace scenes
