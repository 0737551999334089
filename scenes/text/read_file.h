// Reads files: scene files, the particle files that they refer to, and, through tools/system/output_file.h, everything
// that the program has written itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// Largest size of a scene file, bytes. Chosen: no scene file is larger.
inline constexpr std::size_t kMaxSceneFileBytes = std::size_t{16} << 20U;

/// Largest size of a particle file, bytes. Chosen: room for about 50 million particles.
inline constexpr std::size_t kMaxParticleFileBytes = std::size_t{4} << 30U;

/// All bytes of a file.
/// @throws InputError if it cannot be read or is larger than the limit
std::vector<std::uint8_t> readFile(const std::string& path,
                                   std::size_t limit = std::numeric_limits<std::size_t>::max());

/// The bytes of a file as text. The view is valid as long as the bytes are.
inline std::string_view asText(const std::vector<std::uint8_t>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace scenes
