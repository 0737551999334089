// Packs pixels, rows in parallel.
#include "render/picture/image.h"

#include <bit>
#include <cstring>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace render {

Image packedImage(PictureSize size, std::span<const std::uint32_t> pixels, int rowLength, Image old) {
    Image image = std::move(old);
    image.width = size.width;
    image.height = size.height;
    image.rgb.resize(image.byteCount());
    const auto width = static_cast<std::size_t>(size.width);
    constexpr int kBand = 64;  // rows per task; chosen: they fit into a core's cache
    tbb::parallel_for(tbb::blocked_range<int>(0, size.height, kBand), [&](const auto& rows) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
            const std::uint32_t* from = &pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(rowLength)];
            std::uint8_t* to = &image.rgb[3 * width * static_cast<std::size_t>(row)];
            // Copies four bytes for each pixel but the last: the fourth byte is overwritten by the next pixel.
            static_assert(std::endian::native == std::endian::little);
            for (std::size_t k = 0; k + 1 < width; ++k) std::memcpy(to + 3 * k, &from[k], sizeof(std::uint32_t));
            std::memcpy(to + 3 * (width - 1), &from[width - 1], 3);
        }
    });
    return image;
}

}  // namespace render
