// The metrics against closed forms and against the psnr and ssim filters of ffmpeg.
#include "render/compare/picture_metrics.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "render/output/child_process.h"
#include "render/output/png.h"
#include "tests/catch.h"
#include "tests/render/test_pictures.h"

using render::Image;
using namespace test_pictures;

namespace {

namespace fs = std::filesystem;

void writePng(const fs::path& path, const Image& image) {
    const auto bytes = render::encodePng(image);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The number after `label` in the output of a filter of ffmpeg for two pictures. They are passed as planar RGB,
/// without a conversion to luma.
double ffmpegSays(const std::string& filter, const std::string& label, const Image& actual, const Image& expected) {
    const fs::path folder = fs::temp_directory_path() / ("globular-metrics-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    writePng(folder / "a.png", actual);
    writePng(folder / "b.png", expected);
    render::ChildProcess child({"ffmpeg", "-hide_banner", "-nostdin", "-i", (folder / "a.png").string(), "-i",
                                (folder / "b.png").string(), "-lavfi",
                                "[0:v]format=gbrp[a];[1:v]format=gbrp[b];[a][b]" + filter, "-f", "null", "-"});
    const std::string ending = child.wait();
    const std::string said = child.output();
    fs::remove_all(folder);
    INFO(said);
    REQUIRE(ending == "");
    std::smatch match;
    REQUIRE(std::regex_search(said, match, std::regex(label + ":([0-9.]+|inf)")));
    return std::stod(match[1]);
}

}  // namespace

TEST_CASE("Differences by hand", "[metrics]") {
    const Image expected = flat(4, 2, {10, 20, 30});
    Image actual = expected;
    actual.rgb[3 * 5 + 2] = 34;  // pixel (1, 1)
    actual.rgb[3 * 2] = 8;       // pixel (2, 0)
    const auto metrics = render::measure(actual, expected, {}, 3);
    CHECK(metrics.pixelCount == 8);
    CHECK(metrics.differing == 2);
    CHECK(metrics.noticeable == 1);
    CHECK(metrics.share() == 1.0 / 8.0);
    CHECK(metrics.largest == 4);
    CHECK(metrics.mean == 6.0 / 24.0);
    CHECK(metrics.meanSquare == 20.0 / 24.0);
    CHECK(metrics.psnr() ==
          Approx(10.0 * std::log10(65025.0 * 24.0 / 20.0)).epsilon(1e-15));  // the rounding of one logarithm
    CHECK(std::isinf(render::measure(expected, expected, {}, 3).psnr()));
    CHECK_THROWS_AS(render::measure(flat(2, 4, {0, 0, 0}), expected, {}, 3), std::invalid_argument);
}

TEST_CASE("Structural similarity of flat pictures is its luminance term", "[metrics]") {
    // Without variance each channel has (2ab + c1) / (a^2 + b^2 + c1), with the c1 of picture_metrics.cpp.
    const double c1 = 416.0 / 4096.0;
    const auto term = [&](double a, double b) { return (2 * a * b + c1) / (a * a + b * b + c1); };
    for (const int size : {1, 5, 8, 11, 64}) {
        const double ssim =
            render::structuralSimilarity(flat(size, size, {40, 0, 9}), flat(size, size, {50, 255, 9}), {});
        CHECK(ssim == Approx((term(40, 50) + term(0, 255) + 1.0) / 3.0).epsilon(1e-14));  // the rounding of means
    }
    CHECK(render::structuralSimilarity(balls(), balls(), {}) == 1.0);
}

TEST_CASE("PSNR and SSIM are ffmpeg's", "[metrics]") {
    for (const auto& [width, height] : {std::pair{160, 90}, std::pair{61, 43}, std::pair{16, 12}}) {
        const Image good = balls(width, height);
        for (const Image& bad :
             {noisy(good, 2), noisy(good, 60), shifted(good), darker(good, 0.98), gray(good), blank(good)}) {
            const auto metrics = render::measure(bad, good, {}, 3);
            INFO(width << "x" << height << ", psnr " << metrics.psnr() << ", ssim " << metrics.ssim);
            // ffmpeg prints six decimals: half of the last one. Both sum up squares as integers.
            CHECK(ffmpegSays("psnr", "average", bad, good) == Approx(metrics.psnr()).margin(0.51e-6));
            // Half of the last decimal, and about eight roundings of 2^-24 on numbers of at most 1, because ffmpeg
            // evaluates a window in float.
            CHECK(ffmpegSays("ssim", "All", bad, good) ==
                  Approx(metrics.ssim).margin(0.5e-6 + 8.0 * std::ldexp(1.0, -24)));
        }
    }
}
