// The 64-bit FNV-1a hash (Fowler, Noll and Vo), by which states and scenes are recognized.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace engine {

/// FNV-1a hash of a sequence of bytes. If the hash of earlier bytes is given, it is continued.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 0xCBF29CE484222325ULL) {
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001B3ULL;
    }
    return hash;
}

/// FNV-1a hash of the bytes of a file.
inline std::uint64_t fnv1aOf(std::span<const std::uint8_t> bytes) {
    return fnv1a(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

/// Continues an FNV-1a hash with the eight bytes of a 64-bit number, lowest byte first on every machine.
constexpr std::uint64_t fnv1a(std::uint64_t word, std::uint64_t hash) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ ((word >> (8 * byte)) & 0xFF)) * 0x100000001B3ULL;
    return hash;
}

/// Writes a 64-bit hash as 16 hexadecimal digits.
inline std::string hexadecimal(std::uint64_t hash) {
    std::string text(16, '0');
    for (int digit = 15; digit >= 0; --digit, hash >>= 4)
        text[static_cast<std::size_t>(digit)] = "0123456789abcdef"[hash & 0xF];
    return text;
}

}  // namespace engine
