// Encodes PNG files with ISA-L, which compresses and computes checksums, and decodes them with stb.
#include "render/output/png.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

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

/// Upper bound of the size of a zlib stream for so many bytes: incompressible data is stored in blocks of 65535 bytes
/// with five more bytes each, and the stream has a head and an end.
std::size_t compressedBound(std::size_t size) {
    return size + 5 * (size / 65535 + 1) + 64;
}

/// Compresses bytes to a zlib stream.
///
/// Where the fast loop of ISA-L 2.30 meets the first byte (isal_deflate_icf_body_hash_hist_04), it once hashes bits of
/// the stream's address in place of data, so that about one picture in a thousand had other bytes in another run
/// (measured). Data of up to 16 bytes go to a function that hashes data alone: the first bytes are compressed by
/// themselves.
Bytes compressed(Bytes& data) {
    constexpr std::size_t kFirst = 8;
    Bytes output(compressedBound(data.size()));
    Bytes levelBuffer(ISAL_DEF_LVL1_DEFAULT);
    isal_zstream stream{};  // isal_deflate_init() leaves some of it as it is
    isal_deflate_init(&stream);
    stream.level = 1;
    stream.level_buf = levelBuffer.data();
    stream.level_buf_size = static_cast<std::uint32_t>(levelBuffer.size());
    stream.gzip_flag = IGZIP_ZLIB;
    stream.next_in = data.data();
    stream.next_out = output.data();
    stream.avail_out = static_cast<std::uint32_t>(output.size());
    const auto compress = [&](std::size_t count, std::uint16_t flush) {
        stream.avail_in = static_cast<std::uint32_t>(count);
        stream.flush = flush;
        stream.end_of_stream = flush == NO_FLUSH ? 1 : 0;
        if (isal_deflate(&stream) != COMP_OK || stream.avail_in != 0)
            throw std::logic_error("render: ISA-L cannot compress a picture");
    };
    const std::size_t first = std::min(kFirst, data.size());
    compress(first, SYNC_FLUSH);
    compress(data.size() - first, NO_FLUSH);
    if (stream.internal_state.state != ZSTATE_END) throw std::logic_error("render: ISA-L has not ended a picture");
    output.resize(stream.total_out);
    return output;
}

/// The samples' bytes as they are compressed: each row begins with the number of its filter. Filter 1 (the difference
/// to the pixel on the left) gives files nearly as small as trying all five filters, and is much faster.
Bytes filtered(const render::PngSamples& samples) {
    const auto pixel = static_cast<std::size_t>(samples.channels * samples.bytesPerSample);
    const std::size_t row = pixel * static_cast<std::size_t>(samples.size.width);
    const auto rows = static_cast<std::size_t>(samples.size.height);
    Bytes filtered(rows * (1 + row));
    for (std::size_t k = 0; k < rows; ++k) {
        const std::uint8_t* from = &samples.bytes[k * row];
        std::uint8_t* to = &filtered[k * (1 + row)];
        *to++ = 1;
        std::copy_n(from, pixel, to);
        for (std::size_t at = pixel; at < row; ++at) to[at] = static_cast<std::uint8_t>(from[at] - from[at - pixel]);
    }
    return filtered;
}

void appendBigEndian(std::uint32_t number, Bytes& to) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::uint8_t>(number >> shift));
}

void appendChunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& file) {
    appendBigEndian(static_cast<std::uint32_t>(data.size()), file);
    const std::size_t begin = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    appendBigEndian(crc32_gzip_refl(0, &file[begin], file.size() - begin), file);
}

/// The chunk that says what the samples are.
Bytes headerOf(const render::PngSamples& samples) {
    constexpr std::array<std::uint8_t, 5> kColorTypes = {0, 0, 4, 2, 6};  // by number of channels
    Bytes header;
    appendBigEndian(static_cast<std::uint32_t>(samples.size.width), header);
    appendBigEndian(static_cast<std::uint32_t>(samples.size.height), header);
    header.push_back(static_cast<std::uint8_t>(8 * samples.bytesPerSample));
    header.push_back(kColorTypes.at(static_cast<std::size_t>(samples.channels)));
    header.insert(header.end(), {0, 0, 0});  // compression and filters of the standard, rows from top to bottom
    return header;
}

}  // namespace

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace render {

std::vector<std::uint8_t> encodePng(const PngSamples& samples) {
    Bytes raw = filtered(samples);
    Bytes file(kSignature.begin(), kSignature.end());
    appendChunk("IHDR", headerOf(samples), file);
    for (const auto& [keyword, text] : samples.texts) {
        const std::string both = keyword + '\0' + text;
        appendChunk("tEXt", {reinterpret_cast<const std::uint8_t*>(both.data()), both.size()}, file);
    }
    appendChunk("IDAT", compressed(raw), file);
    appendChunk("IEND", {}, file);
    return file;
}

std::vector<std::uint8_t> encodePng(const Image& image) {
    return encodePng({{image.width, image.height}, 3, 1, image.rgb});
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
