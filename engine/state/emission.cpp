// Draws site, displacement, velocity and orientation of an emission.
#include "engine/state/emission.h"

#include <cmath>

#include "engine/core/random.h"
#include "engine/state/emitter_sites.h"

namespace engine {
namespace {

/// The purposes of an emitter's random numbers; each purpose has a stream of random numbers of its own.
enum class Purpose : std::uint64_t { site = 0, jitterFirst = 1, jitterSecond = 2, others = 3 };

std::uint64_t drawBits(const Setup& setup, const Emission& emission, Purpose purpose) {
    const std::uint64_t stream =
        (emission.emitter << 40) ^ (emission.schedule << 2) ^ static_cast<std::uint64_t>(purpose);
    return randomBits(setup.seed, stream, emission.number);
}

/// As many random numbers as an emission needs, one after another.
class Draws {
 public:
    explicit Draws(std::uint64_t bits) : bits_(bits) {}

    /// A random number in [-1, 1).
    double next() {
        bits_ = scatter(bits_);
        return symmetricUnit(bits_);
    }

    /// A random point of the unit ball.
    Vec3 inBall() {
        for (;;) {
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis) point[axis] = next();
            const double lengthSq = squaredLength(point);
            if (lengthSq <= 1.0 && lengthSq > 0.01) return point;
        }
    }

 private:
    std::uint64_t bits_;
};

Vec3 siteOf(const Setup& setup, const Emission& emission) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    if (emitter.pick != Pick::random) return emitter.sites[emission.schedule];
    std::uint64_t bits = drawBits(setup, emission, Purpose::site);
    if (emission.attempt > 0) bits = scatter(bits + emission.attempt);
    return emitter.sites[bits % emitter.sites.size()];
}

/// Random displacement across the emitter's velocity, in units of the emitter's jitter.
Vec3 jitterOf(const Setup& setup, const Emission& emission) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    if (emitter.jitter == 0.0) return Vec3::Zero();
    const PlaneAxes plane = axesAcross(emitter.velocity);
    return symmetricUnit(drawBits(setup, emission, Purpose::jitterFirst)) * plane.first +
           symmetricUnit(drawBits(setup, emission, Purpose::jitterSecond)) * plane.second;
}

/// The velocity at the site, m/s. Its direction is spread evenly over a spherical cap of height h = 1 - cos(a): the
/// height of a point of the cap is spread evenly, and so is the squared distance q of a point of the unit disc from the
/// middle. From z = 1 - q h, sin^2 = 1 - z^2 = q h (2 - q h).
Vec3 velocityOf(const Emitter& emitter, Draws& draws) {
    Vec3 velocity = emitter.velocity;
    if (emitter.spread > 0.0) {
        double x = 0.0;
        double y = 0.0;
        do {
            x = draws.next();
            y = draws.next();
        } while (x * x + y * y > 1.0);
        const double depth = (x * x + y * y) * emitter.spread;
        const double across = std::sqrt(emitter.spread * (2.0 - depth)) * std::sqrt(squaredLength(velocity));
        const PlaneAxes plane = axesAcross(velocity);
        velocity = (1.0 - depth) * velocity + across * (x * plane.first + y * plane.second);
    }
    if (emitter.speedSpread > 0.0) velocity *= 1.0 + emitter.speedSpread * draws.next();
    return velocity;
}

/// The positions of a cluster's particles around its site in a random orientation, m.
std::vector<Vec3> clusterOf(const Emitter& emitter, Draws& draws) {
    if (emitter.cluster.size() == 1) return emitter.cluster;
    Vec3 first = draws.inBall();
    first /= std::sqrt(squaredLength(first));
    const PlaneAxes plane = axesAcross(first);
    double x = 0.0;
    double y = 0.0;
    do {
        x = draws.next();
        y = draws.next();
    } while (x * x + y * y > 1.0 || x * x + y * y < 0.01);
    const Vec3 second = (x * plane.first + y * plane.second) / std::sqrt(x * x + y * y);
    const Vec3 third = first.cross(second);
    std::vector<Vec3> positions;
    for (const Vec3& offset : emitter.cluster)
        positions.push_back(offset.x() * first + offset.y() * second + offset.z() * third);
    return positions;
}

}  // namespace

void drawEmission(const Setup& setup, const Emission& emission, double time, double late,
                  std::vector<NewParticle>& particles) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    const Material& material = setup.materials[emitter.material];
    Draws draws(drawBits(setup, emission, Purpose::others));
    Launch launch;
    launch.velocity = velocityOf(emitter, draws);
    launch.position = siteOf(setup, emission) + emitter.jitter * material.radius * jitterOf(setup, emission);
    const auto [site, velocity] = launchAt(emitter, time - late, launch);
    NewParticle particle;
    const Vec3 flight = late * velocity + 0.5 * late * late * setup.gravity;
    particle.velocity = velocity + late * setup.gravity;
    particle.radius = material.radius;
    particle.mass = material.mass;
    particle.birthTime = time - late;
    particle.material = emitter.material;
    if (setup.heat) {
        const double enthalpy = enthalpyAt(material.thermal, emitter.temperature);
        particle.enthalpy = material.mass * enthalpy;
        particle.material = stageAt(*setup.heat, setup.materials, emitter.material, enthalpy);
    }
    particles.clear();
    for (const Vec3& offset : clusterOf(emitter, draws)) {
        particle.position = emitter.cluster.size() == 1 ? site : Vec3(site + offset);
        particle.position += flight;
        particles.push_back(particle);
    }
}

}  // namespace engine
