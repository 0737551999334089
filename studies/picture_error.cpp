// Sums over the windows' pixels.
#include "studies/picture_error.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace studies {
namespace {

constexpr int kSide = 11;

std::array<double, kSide * kSide> gaussian() {
    std::array<double, kSide * kSide> weights{};
    double sum = 0.0;
    for (int k = 0; k < kSide * kSide; ++k) {
        const double x = k % kSide - kSide / 2;
        const double y = k / kSide - kSide / 2;
        sum += weights[static_cast<std::size_t>(k)] = std::exp(-(x * x + y * y) / (2.0 * 1.5 * 1.5));
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// BT.601's weights, as SSIM is usually computed.
double luma(std::span<const std::uint8_t> rgb, std::size_t pixel) {
    return 0.299 * rgb[3 * pixel] + 0.587 * rgb[3 * pixel + 1] + 0.114 * rgb[3 * pixel + 2];
}

double meanRadius(const render::View& view) {
    double sum = 0.0;
    for (const render::Sphere& particle : view.particles) sum += double(particle.radius);
    return view.particles.empty() ? 1.0 : sum / static_cast<double>(view.particles.size());
}

/// What the windows add up to.
struct Sums {
    double squares = 0.0;
    double similarity = 0.0;
    double depth = 0.0;
    double normal = 0.0;
    std::size_t wrong = 0;
    std::size_t hits = 0;
    std::size_t pixels = 0;
};

void addColors(const render::Image& image, const ExactWindow& exact, Sums& sums) {
    const auto width = static_cast<std::size_t>(exact.window.width);
    std::vector<double> shown;
    std::vector<double> wanted;
    for (std::size_t k = 0; k < exact.picture.kinds.size(); ++k) {
        const std::size_t place =
            (static_cast<std::size_t>(exact.window.y) + k / width) * static_cast<std::size_t>(image.width) +
            static_cast<std::size_t>(exact.window.x) + k % width;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double step = double(image.rgb[3 * place + channel]) - double(exact.picture.rgb[3 * k + channel]);
            sums.squares += step * step;
        }
        shown.push_back(luma(image.rgb, place));
        wanted.push_back(luma(exact.picture.rgb, k));
    }
    sums.similarity += structuralSimilarity(shown, wanted, exact.window.width, exact.window.height);
}

void addSurfaces(const render::View& view, render::PictureSize size, std::span<const render::SurfacePoint> surfaces,
                 const ExactWindow& exact, Sums& sums) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.camera.target) - glm::dvec3(view.camera.eye));
    const double radius = meanRadius(view);
    for (std::size_t k = 0; k < exact.picture.kinds.size(); ++k) {
        const int x = exact.window.x + static_cast<int>(k) % exact.window.width;
        const int y = exact.window.y + static_cast<int>(k) / exact.window.width;
        const render::SurfacePoint& seen = surfaces[static_cast<std::size_t>(y * size.width + x)];
        const oracle::Hit::Kind kind = exact.picture.kinds[k];
        ++sums.pixels;
        const bool hit = kind != oracle::Hit::Kind::none;
        if (hit != (seen.depth >= 0.0F)) ++sums.wrong;
        if (!hit || seen.depth < 0.0F) continue;
        const oracle::Ray ray = oracle::pixelRay(view, size, x + 0.5, y + 0.5);
        const double depth = exact.picture.distances[k] * glm::dot(ray.direction, forward);
        const double error = std::abs(double(seen.depth) - depth) / radius;
        // The ground is far away and seen at a slant: single precision shifts it by more.
        const bool right = error <= 0.1 + 1e-5 * depth / radius;
        if (!right) ++sums.wrong;
        if (!right || kind != oracle::Hit::Kind::particle) continue;
        ++sums.hits;
        sums.depth += error;
        const double cosine = glm::dot(glm::dvec3(seen.normal), exact.picture.normals[k]);
        const double sine = glm::length(glm::cross(glm::dvec3(seen.normal), exact.picture.normals[k]));
        sums.normal += std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
    }
}

}  // namespace

double structuralSimilarity(std::span<const double> a, std::span<const double> b, int width, int height) {
    if (width < kSide || height < kSide) throw std::logic_error("structuralSimilarity: smaller than its window");
    static const std::array<double, kSide* kSide> weights = gaussian();
    constexpr double kMean = (0.01 * 255.0) * (0.01 * 255.0);
    constexpr double kContrast = (0.03 * 255.0) * (0.03 * 255.0);
    double sum = 0.0;
    for (int top = 0; top + kSide <= height; ++top) {
        for (int left = 0; left + kSide <= width; ++left) {
            double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
            for (int k = 0; k < kSide * kSide; ++k) {
                const auto place = static_cast<std::size_t>((top + k / kSide) * width + left + k % kSide);
                const double w = weights[static_cast<std::size_t>(k)];
                ma += w * a[place];
                mb += w * b[place];
                aa += w * a[place] * a[place];
                bb += w * b[place] * b[place];
                ab += w * a[place] * b[place];
            }
            aa -= ma * ma;
            bb -= mb * mb;
            ab -= ma * mb;
            sum += (2.0 * ma * mb + kMean) * (2.0 * ab + kContrast) /
                   ((ma * ma + mb * mb + kMean) * (aa + bb + kContrast));
        }
    }
    return sum / ((width - kSide + 1) * (height - kSide + 1));
}

PictureError errorOf(const render::Image& image, std::span<const render::SurfacePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact) {
    Sums sums;
    for (const ExactWindow& window : exact) {
        addColors(image, window, sums);
        addSurfaces(view, {image.width, image.height}, surfaces, window, sums);
    }
    PictureError error;
    error.pixels = sums.pixels;
    error.rmse = std::sqrt(sums.squares / (3.0 * static_cast<double>(sums.pixels)));
    error.ssim = sums.similarity / static_cast<double>(exact.size());
    error.wrongHits = static_cast<double>(sums.wrong) / static_cast<double>(sums.pixels);
    const auto hits = static_cast<double>(std::max<std::size_t>(sums.hits, 1));
    error.depth = sums.depth / hits;
    error.normal = sums.normal / hits;
    return error;
}

}  // namespace studies
