#include "scenes/shapes/image_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "scenes/text/input_error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wextra"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace scenes {
namespace {

/// Pixels along the edge of a square that is outlined together, so that edges that follow one another are near.
constexpr int kTile = 8;

/// Darkness of each pixel above middle gray, from -127.5 to 127.5. Beyond the image it is light.
struct Darkness {
    int width = 0;
    int height = 0;
    std::vector<double> pixels;

    double at(int x, int y) const {
        if (x < 0 || y < 0 || x >= width || y >= height) return -127.5;
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

Darkness decode(const std::vector<std::uint8_t>& bytes, const std::string& path) {
    Darkness image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &image.width, &image.height, &channels, 2),
        &stbi_image_free);
    if (!pixels) throw InputError(path, fmt::format("not a PNG: {}", stbi_failure_reason()));
    const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.pixels.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double gray = pixels.get()[2 * k];
        const double opacity = pixels.get()[2 * k + 1] / 255.0;
        image.pixels.push_back((255.0 - gray) * opacity - 127.5);
    }
    return image;
}

/// Appends the edges of the outline in the square between the middles of four pixels: marching squares. Where two
/// opposite corners are dark, they are not joined.
void appendSquare(const Darkness& image, int x, int y, std::vector<std::array<OutlinePoint, 2>>& edges) {
    const std::array<std::array<int, 2>, 4> corners = {{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) values[k] = image.at(corners[k][0], corners[k][1]);
    std::vector<OutlinePoint> entries;  // where the boundary of the square goes from light to dark
    std::vector<OutlinePoint> exits;
    std::size_t firstChange = 4;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        if ((values[k] > 0.0) == (values[next] > 0.0)) continue;
        // Computed from the light end, so that both squares at this side find the same point.
        const std::size_t light = values[k] > 0.0 ? next : k;
        const std::size_t dark = values[k] > 0.0 ? k : next;
        const double share = values[light] / (values[light] - values[dark]);
        OutlinePoint point{};
        for (std::size_t axis = 0; axis < 2; ++axis)
            point[axis] = corners[light][axis] + share * (corners[dark][axis] - corners[light][axis]);
        (values[k] > 0.0 ? exits : entries).push_back(point);
        if (firstChange == 4) firstChange = k;
    }
    if (entries.empty()) return;
    // Each dark corner lies between an entry and the exit after it. If the first change is an exit, that belongs to the
    // last entry.
    const bool startsInDark = values[firstChange] > 0.0;
    for (std::size_t k = 0; k < entries.size(); ++k)
        edges.push_back({entries[k], exits[startsInDark ? (k + 1) % exits.size() : k]});
}

}  // namespace

ImageOutline imageOutline(const std::vector<std::uint8_t>& bytes, const std::string& path) {
    const Darkness image = decode(bytes, path);
    ImageOutline result;
    result.aspect = static_cast<double>(image.height) / image.width;
    auto& edges = result.outline.edges;
    for (int tileY = -1; tileY < image.height; tileY += kTile)
        for (int tileX = -1; tileX < image.width; tileX += kTile)
            for (int y = tileY; y < std::min(tileY + kTile, image.height); ++y)
                for (int x = tileX; x < std::min(tileX + kTile, image.width); ++x) appendSquare(image, x, y, edges);
    for (auto& edge : edges)
        for (OutlinePoint& point : edge)
            point = {(point[0] + 0.5) / image.width - 0.5, (0.5 * image.height - point[1] - 0.5) / image.width};
    return result;
}

}  // namespace scenes
