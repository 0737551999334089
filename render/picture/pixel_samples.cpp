// The points of the lens are found without sine and cosine, whose last bits differ between machines.
#include "render/picture/pixel_samples.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "render/picture/camera_frame.h"

namespace render {

namespace {

/// The points of the lens in the order of the spiral, moved so that their mean is its middle.
std::vector<glm::dvec2> lensPoints(int count) {
    // Cosine and sine of the golden angle, pi (3 - sqrt(5)).
    constexpr double kCosine = -0.7373688780783197;
    constexpr double kSine = 0.6754902942615238;
    std::vector<glm::dvec2> points;
    glm::dvec2 direction(1.0, 0.0);
    glm::dvec2 sum(0.0);
    for (int k = 0; k < count; ++k) {
        points.push_back(std::sqrt((k + 0.5) / count) * direction);
        sum += points.back();
        direction = {kCosine * direction.x - kSine * direction.y, kSine * direction.x + kCosine * direction.y};
    }
    for (glm::dvec2& point : points) point -= sum / static_cast<double>(count);
    return points;
}

/// Moves the particles to where they are at a moment.
void moveParticles(const View& view, float time, std::vector<Sphere>& particles) {
    const std::vector<glm::vec3>& velocities = view.shutter->velocities;
    for (std::size_t k = 0; k < velocities.size(); ++k)
        particles[k].center = view.particles[k].center + time * velocities[k];
}

void requireWhole(const View& view) {
    const Shutter& shutter = *view.shutter;
    const auto samples = static_cast<std::size_t>(view.samplesPerAxis * view.samplesPerAxis);
    const std::size_t velocities = shutter.velocities.size();
    if (shutter.moments.size() != samples || (velocities != 0 && velocities != view.particles.size()))
        throw std::logic_error(fmt::format("render: {} moments for {} samples, {} velocities for {} particles",
                                           shutter.moments.size(), samples, velocities, view.particles.size()));
}

}  // namespace

PixelSample pixelSample(int index, int samplesPerAxis) {
    const int n = samplesPerAxis;
    const int count = n * n;
    const int row = index / n;
    const int column = index % n;
    const double time = sampleTime(index, n);
    const int part = static_cast<int>((time + 0.5) * count);
    const int onLens = n * ((part % n + 2) % n) + (part / n + part % n) % n;
    return {glm::vec2(2 * column + 1 - n, 2 * row + 1 - n) / static_cast<float>(2 * n), time,
            glm::vec2(lensPoints(count)[static_cast<std::size_t>(onLens)])};
}

bool hasBlur(const View& view) {
    if (view.shutter) return true;
    return view.camera.aperture > 0.0F && view.camera.projection == Projection::perspective;
}

Camera throughLens(const Camera& camera, glm::vec2 onLens) {
    if (!(camera.aperture > 0.0F) || camera.projection != Projection::perspective) return camera;
    const CameraFrame frame = cameraFrame(camera, {1, 1});
    const glm::vec2 beside = 0.5F * camera.aperture * onLens;
    const float focus = camera.focus > 0.0F ? camera.focus : distance(camera.eye, camera.target);
    Camera seen = camera;
    const glm::vec3 way = beside.x * frame.right + beside.y * frame.up;
    seen.eye += way;
    seen.target += way;
    // A point (x, y, focus) of the axes through the lens' middle is at (x - beside.x, y - beside.y, focus) of those
    // through the point of the lens, and must stay at (x, y)/focus of the picture.
    seen.shift -= beside / focus;
    return seen;
}

void setSample(const View& view, int index, View& sampled) {
    const PixelSample sample = pixelSample(index, view.samplesPerAxis);
    sampled.camera = view.camera;
    if (view.shutter) {
        requireWhole(view);
        const Moment& moment = view.shutter->moments[static_cast<std::size_t>(index)];
        moveParticles(view, moment.time, sampled.particles);
        sampled.camera = moment.camera;
        sampled.sphereObstacles = moment.sphereObstacles;
        sampled.boxObstacles = moment.boxObstacles;
        sampled.meshObstacles = moment.meshObstacles;
        sampled.edges = moment.edges;
    }
    sampled.camera = throughLens(sampled.camera, sample.onLens);
    sampled.camera.aperture = 0.0F;
    sampled.shutter.reset();
}

}  // namespace render
