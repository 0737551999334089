// Simulations of surface tension: a cube becomes a ball, the tension of drops is the one that the scene asks for, a
// long bridge breaks, a drop oscillates, and what wets a plate hangs from it.
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/forces/forces.h"
#include "engine/run/advance.h"

using engine::Particles;
using engine::Vec3;
using scenes_test::sceneOf;

namespace {

/// A scene without gravity of oil with a surface tension of 10 N/m, but for its bodies.
std::string oilScene(const std::string& material, double seconds) {
    return "title = \"drops\"\nduration = " + std::to_string(seconds) +
           "\n[physics]\ngravity = [0, 0, 0]\nstepper = \"velocity-verlet\"\nstep = 0.004\n[[material]]\npreset = "
           "\"oil\"\n" +
           material;
}

engine::Simulation simulated(const std::string& text) {
    const scenes::Scene scene = sceneOf(text);
    engine::Simulation simulation = engine::start(scene.setup);
    engine::advance(simulation, scene.duration);
    return simulation;
}

Vec3 centerOf(const Particles& particles) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& position : particles.position) sum += position;
    return sum / static_cast<double>(particles.count());
}

/// sum x^4 + y^4 + z^4 over sum r^4 from the center: 0.474 for a cube, 0.600 for a ball.
double roundnessOf(const Particles& particles) {
    const Vec3 center = centerOf(particles);
    double fourths = 0.0;
    double all = 0.0;
    for (const Vec3& position : particles.position) {
        const Vec3 from = position - center;
        all += std::pow(from.squaredNorm(), 2);
        fourths += from.array().pow(4).sum();
    }
    return fourths / all;
}

/// Energy of the pairs of particles, J.
double energyOf(const engine::Simulation& simulation) {
    return engine::pairEnergyReference(forceFieldOf(simulation.setup), simulation.particles);
}

/// Pressure in the middle of a ball of this radius (m), Pa, by the virial theorem (see compression.cpp).
double innerPressure(const engine::Simulation& simulation, double radius) {
    const Particles& particles = simulation.particles;
    const engine::Material& material = simulation.setup.materials.front();
    const double rest = 2.0 * material.radius;
    const auto law = engine::pairConstants<double>(material, rest);
    const Vec3 center = centerOf(particles);
    double virial = 0.0;
    double count = 0.0;
    for (const Vec3& position : particles.position) {
        if ((position - center).norm() > radius) continue;
        count += 1.0;
        for (const Vec3& other : particles.position) {
            const double square = (position - other).squaredNorm();
            if (square > 0.0) virial += square * engine::pairCoefficient<engine::kConservative>(square, 0.0, law);
        }
    }
    return virial / (6.0 * count * std::pow(rest, 3) / std::sqrt(2.0));
}

/// A drop of liquid whose particles move at random, by its bulk.
struct LiquidDrop {
    double density = 0.0;   ///< kg/m^3
    double pressure = 0.0;  ///< Pa
};

/// Density and pressure within a distance (m) of the middle of a drop, by the virial theorem with the random motion.
LiquidDrop bulkOf(const engine::Simulation& simulation, double distance) {
    const Particles& particles = simulation.particles;
    const engine::Material& material = simulation.setup.materials.front();
    const auto law = engine::pairConstants<double>(material, 2.0 * material.radius);
    const Vec3 center = centerOf(particles);
    double count = 0.0;
    double virial = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        if ((particles.position[p] - center).norm() > distance) continue;
        count += 1.0;
        virial += material.mass * particles.velocity[p].squaredNorm();
        for (const Vec3& other : particles.position) {
            const double square = (particles.position[p] - other).squaredNorm();
            if (square > 0.0) virial += 0.5 * square * engine::pairCoefficient<engine::kConservative>(square, 0.0, law);
        }
    }
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(distance, 3);
    return {material.mass * count / volume, virial / (3.0 * volume)};
}

/// By how much longer than wide a drop of this radius (m) is: the mean of z^2 - (x^2 + y^2) / 2, without what has
/// evaporated.
double elongationOf(const Particles& particles, double radius) {
    const Vec3 center = centerOf(particles);
    double sum = 0.0;
    double count = 0.0;
    for (const Vec3& position : particles.position) {
        const Vec3 from = position - center;
        if (from.norm() > 1.7 * radius) continue;
        count += 1.0;
        sum += from.z() * from.z() - 0.5 * (from.x() * from.x() + from.y() * from.y());
    }
    return sum / count;
}

/// The frequency without damping (1/s) of the damped oscillation from 0 that is closest to samples at equal intervals
/// (s): sqrt(w^2 + g^2) of A exp(-g t) sin(w t).
double frequencyOf(const std::vector<double>& samples, double interval) {
    double least = std::numeric_limits<double>::infinity();
    double frequency = 0.0;
    for (double w = 0.2; w < 4.0; w += 0.01)
        for (double g = 0.0; g < 3.0; g += 0.01) {
            double ofSine = 0.0;
            double ofSamples = 0.0;
            double all = 0.0;
            for (std::size_t k = 0; k < samples.size(); ++k) {
                const double time = interval * static_cast<double>(k);
                const double sine = std::exp(-g * time) * std::sin(w * time);
                ofSine += sine * sine;
                ofSamples += sine * samples[k];
                all += samples[k] * samples[k];
            }
            const double rest = all - ofSamples * ofSamples / ofSine;
            if (rest >= least) continue;
            least = rest;
            frequency = std::hypot(w, g);
        }
    return frequency;
}

/// Number of pieces: sets of particles that are not within a distance of each other.
std::size_t pieceCount(const Particles& particles, double distance) {
    std::size_t pieces = 0;
    std::vector<bool> isSeen(particles.count());
    for (std::size_t start = 0; start < particles.count(); ++start) {
        if (isSeen[start]) continue;
        ++pieces;
        std::vector<std::size_t> open = {start};
        isSeen[start] = true;
        while (!open.empty()) {
            const std::size_t p = open.back();
            open.pop_back();
            for (std::size_t i = 0; i < particles.count(); ++i) {
                if (isSeen[i] || (particles.position[p] - particles.position[i]).norm() > distance) continue;
                isSeen[i] = true;
                open.push_back(i);
            }
        }
    }
    return pieces;
}

std::string ball(double radius) {
    return "[[body]]\nshape = \"ball\"\ncenter = [0, 0, 0]\nradius = " + std::to_string(radius) + "\n";
}

}  // namespace

TEST_CASE("a cube of a liquid with cohesion becomes a ball", "[drops][long]") {
    // A cubic grid of the density at rest. A cube of densest packing is a crystal, which keeps more of its form.
    const std::string cube = R"([[body]]
shape = "grid"
counts = [10, 10, 10]
spacing = 0.1426
jitter = 0.1
center = [0, 0, 0]
)";
    const engine::Simulation with = simulated(oilScene("cohesion = 10\n", 4.0) + cube);
    const engine::Simulation without = simulated(oilScene("", 4.0) + cube);
    const engine::Simulation liquid = simulated(oilScene("cohesion = 10\nagitation = 0.04\n", 4.0) + cube);
    // Without random motion it sets before it is round.
    CHECK(roundnessOf(with.particles) > 0.56);
    CHECK(roundnessOf(liquid.particles) > 0.59);
    CHECK(roundnessOf(without.particles) < 0.50);
    // Its volume stays: the radius of gyration of a ball of the same volume is sqrt(3/5) R.
    const double volume = static_cast<double>(with.particles.count()) * std::pow(0.16, 3) / std::sqrt(2.0);
    const double radius = std::cbrt(0.75 * volume / std::numbers::pi);
    const Vec3 center = centerOf(with.particles);
    double square = 0.0;
    for (const Vec3& position : with.particles.position) square += (position - center).squaredNorm();
    const double gyration = std::sqrt(square / static_cast<double>(with.particles.count()));
    CHECK(gyration == Approx(std::sqrt(0.6) * radius).epsilon(0.08));  // a tenth of a particle's diameter
}

TEST_CASE("drops have the surface energy of their tension", "[drops][long]") {
    // A drop's energy is that of its bulk, which goes with the number of particles, and of its surface: 4 pi R^2 sigma.
    constexpr double kTension = 10.0;
    struct Drop {
        double count, area, energy;
    };
    std::vector<Drop> drops;
    for (const double radius : {0.7, 1.1}) {
        const engine::Simulation drop = simulated(oilScene("cohesion = 10\nbd = 0.5\n", 3.0) + ball(radius));
        const auto count = static_cast<double>(drop.particles.count());
        const double volume = count * std::pow(0.16, 3) / std::sqrt(2.0);
        const double area = std::pow(36.0 * std::numbers::pi * volume * volume, 1.0 / 3.0);
        drops.push_back({count, area, energyOf(drop)});
    }
    const Drop& small = drops[0];
    const Drop& large = drops[1];
    const double ratio = large.count / small.count;
    const double tension = (large.energy - ratio * small.energy) / (large.area - ratio * small.area);
    CHECK(tension == Approx(kTension).epsilon(0.15));  // kRelaxation is measured to 4 %, and differs by 8 % by size
}

TEST_CASE("the pressure in a drop is that of Laplace", "[drops][long]") {
    // It starts as a grid, far from the densest packing: a ball of that lattice would bear a stress like a solid.
    const engine::Simulation drop = simulated(
        oilScene("cohesion = 10\nbd = 0.5\n", 5.0) +
        "[[body]]\nshape = \"grid\"\ncounts = [12, 12, 12]\nspacing = 0.1426\njitter = 0.1\ncenter = [0, 0, 0]\n");
    const double volume = static_cast<double>(drop.particles.count()) * std::pow(0.16, 3) / std::sqrt(2.0);
    const double radius = std::cbrt(0.75 * volume / std::numbers::pi);
    // The pull of the surface does not reach the inner four tenths. Measured are 1.02 times Laplace's pressure in a
    // drop of 5000 particles, and 0.96 here, where only 110 particles lie there; other rest ratios gave 0.83 to 1.03.
    CHECK(innerPressure(drop, 0.4 * radius) == Approx(2.0 * 10.0 / radius).epsilon(0.2));
}

TEST_CASE("a bridge between two plates breaks if it is longer than its circumference", "[drops][long]") {
    // Plateau: a cylinder of liquid is unstable to waves longer than its circumference, which here is 1.9 m.
    const auto piecesOf = [](double height) {
        std::string text =
            oilScene("cohesion = 10\n", 6.0) +
            "[[body]]\nshape = \"cylinder\"\ncenter = [0, 0, 0]\nradius = 0.3\nheight = " + std::to_string(height) +
            "\n";
        for (const double side : {-1.0, 1.0})
            text += "[[obstacle]]\nshape = \"plane\"\npoint = [0, " + std::to_string(side * (0.5 * height + 0.05)) +
                    ", 0]\nnormal = [0, " + std::to_string(-side) + ", 0]\ncontact_angle = 30\n";
        return pieceCount(simulated(text).particles, 0.3);  // a gap of a particle's diameter
    };
    CHECK(piecesOf(1.0) == 1);
    CHECK(piecesOf(2.8) == 2);
}

TEST_CASE("a liquid that wets a plate hangs from it", "[drops][long]") {
    const auto heightWith = [](const std::string& angle) {
        const engine::Simulation hanging = simulated(R"(title = "spoon"
duration = 2
[physics]
stepper = "velocity-verlet"
step = 0.003
[[material]]
preset = "honey"
cohesion = 20
[[body]]
shape = "ball"
center = [0, -0.3, 0]
radius = 0.3
[[obstacle]]
shape = "box"
minimum = [-2, 0, -2]
maximum = [2, 0.5, 2]
)" + angle);
        return centerOf(hanging.particles).y();
    };
    CHECK(heightWith("contact_angle = 30\n") > -0.4);
    CHECK(heightWith("") < -2.0);  // half of 9.8 m/s^2 (2 s)^2, less what the drag of nothing takes
}

TEST_CASE("a drop oscillates at the frequency of Rayleigh", "[drops][long]") {
    // w^2 = 8 sigma / (rho R^3), with the tension that the pressure in the drop at rest shows. The drop is set into
    // motion by a flow that stretches it: were its particles moved, it would first spring back like a solid. The mean
    // of some drops is what is left when their random motion is taken off.
    constexpr int kDrops = 4;
    constexpr int kSamples = 100;
    constexpr double kInterval = 0.05;
    constexpr double kRest = 2.5;  // s until the drop is at rest
    std::vector<double> elongations(kSamples + 1, 0.0);
    LiquidDrop bulk;
    double mass = 0.0;
    for (int seed = 1; seed <= kDrops; ++seed) {
        const scenes::Scene scene = sceneOf("seed = " + std::to_string(seed) + "\n" +
                                            oilScene("cohesion = 10\nbd = 0.02\nagitation = 0.1\n", 5.0) + ball(1.134) +
                                            "spacing = 0.155\njitter = 0.1\n");
        engine::Setup setup = scene.setup;
        setup.step = 0.006;
        engine::Simulation rest = engine::start(setup);
        engine::advance(rest, kRest);
        mass = scene.setup.materials.front().mass * static_cast<double>(rest.particles.count());
        for (int sample = 1; sample <= 40; ++sample) {
            engine::advance(rest, kRest + kInterval * sample);
            const LiquidDrop now = bulkOf(rest, 0.6);
            bulk.density += now.density / (40 * kDrops);
            bulk.pressure += now.pressure / (40 * kDrops);
        }
        setup.initial = rest.particles;
        setup.seed += 100;
        const Vec3 center = centerOf(setup.initial);
        for (std::size_t p = 0; p < setup.initial.count(); ++p) {
            const Vec3 from = setup.initial.position[p] - center;
            if (from.norm() < 1.7) setup.initial.velocity[p] += 0.35 * Vec3(-0.5 * from.x(), -0.5 * from.y(), from.z());
        }
        engine::Simulation moved = engine::start(setup);
        for (int sample = 0; sample <= kSamples; ++sample) {
            engine::advance(moved, kInterval * sample);
            elongations[static_cast<std::size_t>(sample)] += elongationOf(moved.particles, 1.21) / kDrops;
        }
    }
    const double radius = std::cbrt(0.75 * mass / (std::numbers::pi * bulk.density));
    const double tension = 0.5 * bulk.pressure * radius;
    const double expected = std::sqrt(8.0 * tension / (bulk.density * std::pow(radius, 3)));
    CHECK(tension == Approx(7.5).epsilon(0.1));  // random motion takes a quarter of the tension of a drop at rest
    // Measured is 0.93 of Rayleigh's frequency, which is that of small amplitudes and of drops with a thin surface:
    // this one is a seventh of the radius thick. Other seeds differ by as much.
    CHECK(frequencyOf(elongations, kInterval) == Approx(expected).epsilon(0.15));
}
