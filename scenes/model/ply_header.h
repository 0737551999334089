// The header of a particle file: what it says of the rows that follow. Used by particle_file.cpp only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

enum class PlyType { float32, float64, uint8, uint16, uint32 };

/// Bytes of a value.
std::size_t sizeOf(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float64;
};

struct PlyHeader {
    std::uint64_t count = 0;              ///< rows
    std::vector<PlyProperty> properties;  ///< of a row, in order
    std::size_t size = 0;                 ///< bytes of the header

    bool has(std::string_view name) const;
};

/// The header of a particle file whose rows fill the rest of the bytes exactly.
/// Throws: InputError that names the file, the line and what is wrong.
PlyHeader readPlyHeader(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
