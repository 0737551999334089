// Encodes and decodes PNG files with the library stb, in which ISA-L takes the place of stb's slow compressor and
// checksum.
#include "render/output/png.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace {

/// Checksum (CRC) of a chunk of a PNG file, in place of the function of stb, which works byte by byte.
unsigned int checksum(const unsigned char* data, int size) {
    return crc32_gzip_refl(0, data, static_cast<std::uint64_t>(size));
}

/// Upper bound of the size of a zlib stream for so many bytes: incompressible data is stored in blocks of 65535 bytes
/// with five more bytes each, and the stream has a head and an end.
std::size_t compressedBound(std::size_t size) {
    return size + 5 * (size / 65535 + 1) + 64;
}

/// Compresses bytes to a zlib stream, in place of the function of stb with the same parameters. The stream is allocated
/// by malloc(), and stb frees it.
unsigned char* compressZlib(unsigned char* data, int size, int* compressedSize, int /*quality*/) {
    const std::size_t bound = compressedBound(static_cast<std::size_t>(size));
    auto* output = static_cast<unsigned char*>(std::malloc(bound));
    if (output == nullptr) return nullptr;
    std::vector<std::uint8_t> levelBuffer(ISAL_DEF_LVL1_DEFAULT);
    isal_zstream stream;
    isal_deflate_stateless_init(&stream);
    stream.level = 1;
    stream.level_buf = levelBuffer.data();
    stream.level_buf_size = static_cast<std::uint32_t>(levelBuffer.size());
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    stream.next_in = data;
    stream.avail_in = static_cast<std::uint32_t>(size);
    stream.next_out = output;
    stream.avail_out = static_cast<std::uint32_t>(bound);
    if (isal_deflate_stateless(&stream) != COMP_OK) {
        std::free(output);
        return nullptr;
    }
    *compressedSize = static_cast<int>(stream.total_out);
    return output;
}

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool isPng(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), bytes.begin());
}

std::uint32_t bigEndian(std::span<const std::uint8_t, 4> bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

/// What is wrong with the chunks of a file, whose layout is: length of the data, four bytes; type, four bytes; data;
/// checksum of type and data, four bytes. nullptr if every chunk up to the last is complete and has its checksum. stb
/// checks neither, and would allocate any length that a damaged chunk claims to have.
const char* damageOf(std::span<const std::uint8_t> file) {
    constexpr std::string_view kLast = "IEND";
    for (std::span<const std::uint8_t> left = file.subspan(kSignature.size()); left.size() >= 12;) {
        const std::size_t length = bigEndian(left.first<4>());
        if (length > left.size() - 12) break;
        const std::span<const std::uint8_t> content = left.subspan(4, 4 + length);
        if (crc32_gzip_refl(0, content.data(), content.size()) != bigEndian(left.subspan(8 + length).first<4>()))
            return "it is damaged: a checksum does not match";
        if (std::equal(kLast.begin(), kLast.end(), content.begin())) return nullptr;
        left = left.subspan(12 + length);
    }
    return "it is cut short";
}

}  // namespace

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STBIW_ZLIB_COMPRESS compressZlib
#define STBIW_CRC32 checksum
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace render {

std::vector<std::uint8_t> encodePng(const Image& image) {
    // Filter 1 of PNG (the difference to the pixel on the left) gives files nearly as small as trying all five filters,
    // and is much faster. The setting is a global variable of stb; it is written once, because frames are encoded by
    // several threads.
    static const int filter = stbi_write_force_png_filter = 1;
    static_cast<void>(filter);
    int size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> png(
        stbi_write_png_to_mem(image.rgb.data(), 3 * image.width, image.width, image.height, 3, &size), std::free);
    if (!png) throw std::bad_alloc();
    return {png.get(), png.get() + size};
}

Image decodePng(std::span<const std::uint8_t> bytes, const std::string& name) {
    const auto require = [&](bool condition, const char* what) {
        if (!condition) throw SystemError(fmt::format("cannot read {} as PNG: {}", name, what));
    };
    require(isPng(bytes), "it is not a PNG file");
    const char* const damage = damageOf(bytes);
    require(damage == nullptr, damage);
    const auto size = static_cast<int>(bytes.size());
    require(stbi_is_16_bit_from_memory(bytes.data(), size) == 0, "it has 16 bits per channel, 8 are expected");
    Image image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 4), stbi_image_free);
    const char* const reason = stbi_failure_reason();  // null where there is no memory to inflate
    require(pixels != nullptr, reason != nullptr ? reason : "outofmem");
    image.rgb.resize(image.byteCount());
    for (std::size_t pixel = 0; pixel < image.byteCount() / 3; ++pixel) {
        require(pixels.get()[4 * pixel + 3] == 255, "it is transparent, an opaque picture is expected");
        std::copy_n(pixels.get() + 4 * pixel, 3, image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return image;
}

}  // namespace render
