// Fuzzes decodePng(): any bytes either give a picture or throw SystemError. Every input is also decoded with the right
// checksums in its chunks, because a fuzzer hardly ever guesses one.
#include <isa-l/crc.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/output/png.h"
#include "render/picture/system_error.h"

namespace {

void decode(const std::vector<std::uint8_t>& bytes) {
    try {
        const render::Image image = render::decodePng(bytes, "fuzzed.png");
        if (image.rgb.size() != image.byteCount()) __builtin_trap();
    } catch (const render::SystemError&) {
    }
}

std::size_t readBigEndian(const std::uint8_t* bytes) {
    return std::size_t{bytes[0]} << 24 | std::size_t{bytes[1]} << 16 | std::size_t{bytes[2]} << 8 | bytes[3];
}

/// The file with its checksums made right. A chunk is the length of its data, its type, the data, and the checksum.
std::vector<std::uint8_t> withChecksums(std::vector<std::uint8_t> file) {
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t length = readBigEndian(&file[at]);
        if (length > file.size() - at - 12) break;
        const std::uint32_t checksum = crc32_gzip_refl(0, &file[at + 4], 4 + length);
        for (std::size_t byte = 0; byte < 4; ++byte)
            file[at + 8 + length + byte] = static_cast<std::uint8_t>(checksum >> (24 - 8 * byte));
        at += 12 + length;
    }
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::vector<std::uint8_t> bytes(data, data + size);
    decode(bytes);
    decode(withChecksums(bytes));
    return 0;
}
