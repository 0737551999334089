// Numbers in the bytes of a binary file: the types that PLY and VTK files share, under names of their own.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string>

namespace scenes {

static_assert(std::endian::native == std::endian::little, "particle files are written little-endian");

/// How numbers of a type are read.
struct NumberType {
    std::size_t size;  ///< bytes
    double (*decode)(const char* littleEndian);
};

template <class Number>
constexpr NumberType numberType() {
    return {sizeof(Number), [](const char* littleEndian) {
                Number number{};
                std::memcpy(&number, littleEndian, sizeof number);
                return static_cast<double>(number);
            }};
}

/// Appends the bytes of a number, or of a vector of numbers.
template <class Value>
void putBytes(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace scenes
