// Makes the dam break of the study of pictures: particles on a jittered cubic lattice under a curved surface, and one
// particle in forty in the air. See dam_break_view.h.
#include "studies/pictures/dam_break_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/core/random.h"

namespace studies {
namespace {

constexpr double kLength = 11.0;   // length of the tank, m
constexpr double kDepth = 3.6;     // depth of the tank, m
constexpr double kSplash = 0.025;  // share of the particles that are in the air

/// The pseudorandom numbers of SplitMix64 with the seed 0.
class Random {
 public:
    /// The next number, uniform in [0, 1).
    double next() {
        const std::uint64_t bits = engine::scatter(state_);
        state_ += 0x9e3779b97f4a7c15ULL;
        return static_cast<double>(bits >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * next(); }

 private:
    std::uint64_t state_ = 0;
};

/// Height of the liquid at a distance x (m) from the left wall, m: high, a slope, low, a small rise at the far wall.
double surfaceHeight(double x) {
    const double t = std::clamp((x - 2.0) / 5.0, 0.0, 1.0);
    const double wall = std::clamp((x - 9.0) / 2.0, 0.0, 1.0);
    return 3.6 - 2.6 * t * t * (3.0 - 2.0 * t) + 0.5 * wall * wall;
}

/// Volume of the liquid in the tank, m^3.
double volume() {
    constexpr int kSlices = 1000;
    double sum = 0.0;
    for (int k = 0; k < kSlices; ++k) sum += surfaceHeight((k + 0.5) * kLength / kSlices);
    return sum / kSlices * kLength * kDepth;
}

/// Color of the particles at a distance x (m) from the left wall.
glm::vec3 colorAt(double x) {
    constexpr std::array<glm::vec3, 4> kRamp = {
        {{0.01F, 0.13F, 0.62F}, {0.02F, 0.45F, 0.55F}, {0.55F, 0.62F, 0.05F}, {0.85F, 0.2F, 0.02F}}};
    const double at = std::clamp(x / kLength, 0.0, 1.0) * 2.999;
    const auto k = static_cast<std::size_t>(at);
    return glm::mix(kRamp[k], kRamp[k + 1], static_cast<float>(at - static_cast<double>(k)));
}

/// The points of a cubic lattice with this spacing (m) below the surface of the liquid.
std::vector<glm::dvec3> lattice(double spacing) {
    std::vector<glm::dvec3> points;
    for (double x = 0.5 * spacing; x < kLength; x += spacing)
        for (double z = 0.5 * spacing; z < kDepth; z += spacing)
            for (double y = 0.5 * spacing; y < surfaceHeight(x); y += spacing) points.emplace_back(x, y, z);
    return points;
}

void addParticles(std::size_t count, render::View& view) {
    const auto airborne = static_cast<std::size_t>(kSplash * static_cast<double>(count));
    // The lattice is made slightly denser than needed and thinned out evenly to the exact number.
    double spacing = std::cbrt(volume() / static_cast<double>(count - airborne));
    std::vector<glm::dvec3> points = lattice(spacing);
    while (points.size() < count - airborne) points = lattice(spacing *= 0.995);
    const auto radius = static_cast<float>(0.55 * spacing);
    Random random;
    const double jitter = 0.12 * spacing;
    for (std::size_t k = 0; k < count - airborne; ++k) {
        glm::dvec3 at = points[k * points.size() / (count - airborne)];
        for (int axis = 0; axis < 3; ++axis) at[axis] += random.between(-jitter, jitter);
        view.particles.push_back({glm::vec3(at) - glm::vec3(5.5F, 0.0F, 1.8F), radius, colorAt(at.x)});
    }
    while (view.particles.size() < count) {
        const glm::dvec3 at(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        if (dot(at, at) > 1.0) continue;
        const glm::dvec3 position = glm::dvec3(9.6, 2.7, 1.8) + at * glm::dvec3(1.1, 1.3, 1.5);
        view.particles.push_back({glm::vec3(position) - glm::vec3(5.5F, 0.0F, 1.8F), radius, colorAt(position.x)});
    }
}

/// The view from the camera of a frame of framesOf(), which moves on a circle.
render::View seenFrom(render::View view, int frame) {
    const float angle = 0.002F * static_cast<float>(frame);
    const glm::vec3 off = view.camera.eye - view.camera.target;
    view.camera.eye = view.camera.target + glm::vec3(off.x * std::cos(angle) + off.z * std::sin(angle), off.y,
                                                     off.z * std::cos(angle) - off.x * std::sin(angle));
    return view;
}

}  // namespace

render::View damBreakView(std::size_t count, render::Style style) {
    render::View view;
    view.style = style;
    addParticles(count, view);
    view.camera.eye = {4.5F, 5.6F, 11.5F};
    view.camera.target = {0.0F, 1.2F, 0.0F};
    view.camera.verticalFov = 0.66F;
    view.light.toLight = glm::normalize(glm::vec3(-0.5F, 0.8F, 0.45F));
    view.light.color = {0.95F, 0.93F, 0.88F};
    view.ambient = {{0.42F, 0.45F, 0.5F}, {0.22F, 0.21F, 0.2F}};
    view.surface.specular = 0.04F;
    view.surface.glossExponent = 8;
    view.surface.reflection = 1.0F;
    view.surface.translucency = 0.3F;
    view.surface.absorption = 0.4F;
    view.surroundings = {{1.2F, 1.3F, 1.4F}, {0.7F, 0.75F, 0.8F}, {0.2F, 0.2F, 0.2F}};
    view.light.softness = 1.0F;
    view.ambient.occlusion = 0.85F;
    view.exposure = 1.0F;
    view.field = {3.0F, render::Skin::smooth};
    view.background = {{0.56F, 0.63F, 0.70F}, {0.74F, 0.77F, 0.79F}};
    view.ground = render::Ground{0.0F, glm::vec3(0.5F), glm::vec3(0.0F), 30.0F};
    return view;
}

std::vector<render::View> framesOf(const render::View& view, int count) {
    std::vector<render::View> frames;
    for (int frame = 0; frame < count; ++frame) frames.push_back(seenFrom(view, frame));
    return frames;
}

}  // namespace studies
