// PNG: decoding returns the encoded pixels, and anything that is not a PNG file is refused.
#include "tests/catch.h"

#include <array>
#include <random>

#include "render/output/png.h"
#include "render/picture/system_error.h"

namespace {

render::Image noise(int width, int height) {
    render::Image image{width, height, {}};
    std::mt19937 random(3);
    image.rgb.resize(image.byteCount());
    for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(random() >> 24);
    return image;
}

/// Leaves a number all over the stack that the next calls use.
[[gnu::noinline]] void fillStack(std::uint16_t value) {
    std::array<volatile std::uint16_t, 200'000> stack;
    for (volatile std::uint16_t& place : stack) place = value;
}

}  // namespace

TEST_CASE("PNG keeps every byte") {
    // Noise is incompressible: it is stored in blocks, here up to more than one.
    for (const auto& [width, height] :
         {std::pair{1, 1}, std::pair{2, 1}, std::pair{17, 3}, std::pair{146, 150}, std::pair{640, 360}}) {
        const render::Image image = noise(width, height);
        const render::Image back = render::decodePng(render::encodePng(image), "noise");
        CHECK(back.width == width);
        CHECK(back.height == height);
        CHECK(back.rgb == image.rgb);
    }
}

TEST_CASE("The bytes of a PNG do not depend on what the stack held before") {
    // Noise of few values that repeats at a distance, so that the compressor's settings show in its output.
    render::Image image = noise(640, 100);
    for (std::size_t k = 0; k < image.rgb.size(); ++k) image.rgb[k] = image.rgb[k % 20'000] & 7U;
    const std::vector<std::uint8_t> first = render::encodePng(image);
    for (std::uint16_t value = 0; value < 20; ++value) {
        fillStack(value);
        CAPTURE(value);
        CHECK((render::encodePng(image) == first));
    }
}

TEST_CASE("PNG compresses") {
    render::Image image{640, 360, {}};
    image.rgb.assign(image.byteCount(), 77);
    CHECK(render::encodePng(image).size() < image.byteCount() / 50);
}

TEST_CASE("A broken PNG is a SystemError that names it") {
    std::vector<std::uint8_t> bytes = render::encodePng(noise(20, 20));
    bytes.resize(bytes.size() / 2);
    CHECK_THROWS_WITH(render::decodePng(bytes, "golden/half.png"), Catch::Contains("golden/half.png"));
    CHECK_THROWS_AS(render::decodePng({}, "empty.png"), render::SystemError);
    auto endless = render::encodePng({2, 2, std::vector<std::uint8_t>(12, 7)});
    endless.at(33) = 0x7F;  // the length of the second chunk: two gigabytes
    CHECK_THROWS_WITH(render::decodePng(endless, "endless.png"), Catch::Contains("cut short"));
}

TEST_CASE("A PNG in which any bit was flipped is refused") {
    const std::vector<std::uint8_t> whole = render::encodePng(noise(6, 5));
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        INFO("bit " << bit % 8 << " of byte " << bit / 8);
        std::vector<std::uint8_t> damaged = whole;
        damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        CHECK_THROWS_AS(render::decodePng(damaged, "damaged.png"), render::SystemError);
    }
}
