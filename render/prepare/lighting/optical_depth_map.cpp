// Each particle adds its kernel to the texels around it. Bands of rows are filled in parallel, each in the particles'
// order.
#include "render/prepare/lighting/optical_depth_map.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "render/picture/bounds.h"
#include "render/prepare/cells/mean_radius.h"
#include "render/prepare/lighting/portable_exponentials.h"

namespace render {

namespace {

/// A particle's kernel on the light's plane.
struct Splat {
    glm::vec2 center{0.0F};  ///< texels from the first
    float radius = 1.0F;     ///< texels
    glm::vec3 peak{0.0F};    ///< optical depth in the kernel's middle
};

class MapFill {
 public:
    MapFill(const LightBasis& basis, const View& view, glm::vec3 eye, OpticalDepthMap& map) : map_(map) {
        for (const Sphere& particle : view.particles) {
            if (particle.radius <= 0.0F) continue;
            const glm::vec2 at(basis.toLightSpace(particle.center - eye));
            splats_.push_back({(at - map.origin) / map.texelSize, kSplatReach * particle.radius / map.texelSize,
                               peakOf(particle, view.surface.medium)});
        }
    }

    void run() {
        constexpr int kBandRows = 32;  // chosen
        tbb::parallel_for(0, (map_.rows + kBandRows - 1) / kBandRows, [&](int band) {
            const int first = band * kBandRows;
            const int last = std::min(first + kBandRows, map_.rows) - 1;
            for (const Splat& splat : splats_) add(splat, first, last);
        });
    }

 private:
    /// The kernel's middle: its integral over the plane, 1/3 pi reach^2 times the middle, is the particle's share of
    /// the body's volume.
    static glm::vec3 peakOf(const Sphere& particle, const Medium& medium) {
        const float thickness = kBodyVolume * 3.0F / (3.1415927F * kSplatReach * kSplatReach) * particle.radius;
        glm::vec3 peak;
        for (int channel = 0; channel < 3; ++channel)
            peak[channel] = -log2Of(std::clamp(particle.color[channel], kDarkestMedium, 1.0F)) * thickness /
                            medium.attenuationDistance;
        return peak;
    }

    /// Adds a kernel to the rows from `first` to `last`.
    void add(const Splat& splat, int first, int last) {
        const auto limits = [&](float middle, int low, int high) {
            return glm::ivec2(std::max(static_cast<int>(std::ceil(middle - splat.radius)), low),
                              std::min(static_cast<int>(std::floor(middle + splat.radius)), high));
        };
        const glm::ivec2 rows = limits(splat.center.y, first, last);
        const glm::ivec2 columns = limits(splat.center.x, 0, map_.columns - 1);
        const float inverse = 1.0F / (splat.radius * splat.radius);
        for (int row = rows.x; row <= rows.y; ++row) {
            for (int column = columns.x; column <= columns.y; ++column) {
                const glm::vec2 off = glm::vec2(column, row) - splat.center;
                const float root = std::max(0.0F, 1.0F - dot(off, off) * inverse);
                const std::size_t at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.columns) +
                                            static_cast<std::size_t>(column));
                for (int channel = 0; channel < 3; ++channel)
                    map_.depths[at + static_cast<std::size_t>(channel)] += root * root * splat.peak[channel];
            }
        }
    }

    OpticalDepthMap& map_;
    std::vector<Splat> splats_;
};

}  // namespace

OpticalDepthMap opticalDepthMap(const LightBasis& basis, const View& view, glm::vec3 eye) {
    Bounds<glm::vec2> bounds;
    float largest = 0.0F;
    for (const Sphere& particle : view.particles) {
        if (particle.radius <= 0.0F) continue;
        bounds.add(glm::vec2(basis.toLightSpace(particle.center - eye)));
        largest = std::max(largest, particle.radius);
    }
    OpticalDepthMap map;
    if (largest == 0.0F) return map;
    constexpr float kMostTexels = 1024.0F;  // along a side; chosen: the map takes at most 12 MB
    const glm::vec2 size = bounds.high - bounds.low + 2.0F * kSplatReach * largest;
    const auto mean = static_cast<float>(meanRadius(view.particles));
    map.texelSize = std::max(0.5F * mean, std::max(size.x, size.y) / (kMostTexels - 4.0F));
    // One texel more on each side than the kernels reach, so that the border is 0.
    map.origin = bounds.low - kSplatReach * largest - map.texelSize;
    map.columns = static_cast<int>(size.x / map.texelSize) + 4;
    map.rows = static_cast<int>(size.y / map.texelSize) + 4;
    map.depths.assign(3 * static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), 0.0F);
    MapFill(basis, view, eye, map).run();
    return map;
}

}  // namespace render
