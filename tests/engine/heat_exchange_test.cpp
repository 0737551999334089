// Heat along given links, against closed forms; and the links between particles, to walls and to the air.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/forces/forces.h"
#include "engine/heat/heat_exchange.h"
#include "engine/state/bodies.h"
#include "tests/engine/clouds.h"

using namespace engine;

namespace {

/// Particles of 1 kg of a material, with links between them that the test gives.
struct Bodies {
    std::vector<Material> materials;
    Particles particles;
    HeatNetwork network;
    HeatScratch scratch;

    explicit Bodies(const Thermal& thermal) : materials(1) { materials[0].thermal = thermal; }

    void add(double temperature) {
        append(particles, {.mass = 1.0, .enthalpy = enthalpyAt(materials[0].thermal, temperature)});
    }

    /// Adds links: linksOf(p) returns pairs of another particle and a conductance (W/K).
    template <class LinksOf>
    void connect(const LinksOf& linksOf) {
        network.begin = {0};
        for (std::size_t p = 0; p < particles.count(); ++p) {
            network.conductanceToOthers.push_back(0.0);
            for (const auto& [other, conductance] : linksOf(p)) {
                network.other.push_back(static_cast<std::uint32_t>(other));
                network.conductance.push_back(conductance);
                network.conductanceToOthers.back() += conductance;
            }
            network.begin.push_back(network.other.size());
        }
        network.conductanceOutside.assign(particles.count(), 0.0);
        network.inflow.assign(particles.count(), 0.0);
    }

    void connectToOutside(std::size_t p, double conductance, double temperature) {
        network.conductanceOutside[p] += conductance;
        network.inflow[p] += conductance * temperature;
    }

    double exchange(double seconds) {
        const ShareNumbers share = [](const auto& own, auto& combined) { combined = own; };
        return exchangeHeat(network, materials, Ranks::alone(), share, seconds, particles, scratch);
    }

    double temperature(std::size_t p) const { return temperatureOf(materials, particles, p); }
    double heat() const { return std::accumulate(particles.enthalpy.begin(), particles.enthalpy.end(), 0.0); }
};

using Links = std::vector<std::pair<std::size_t, double>>;

/// The two neighbors of a particle in a ring or a chain.
Links neighborsInRing(std::size_t p, std::size_t count, double conductance) {
    return {{(p + 1) % count, conductance}, {(p + count - 1) % count, conductance}};
}

Links neighborsInChain(std::size_t p, std::size_t count, double conductance) {
    Links links;
    if (p > 0) links.emplace_back(p - 1, conductance);
    if (p + 1 < count) links.emplace_back(p + 1, conductance);
    return links;
}

constexpr Thermal kPlain{.capacity = 1000.0, .conductivity = 5.0};
constexpr Thermal kMelting{.capacity = 1000.0, .conductivity = 5.0, .melting = 350.0, .latent = 2e4};
constexpr Thermal kSoftening{
    .capacity = 1000.0, .conductivity = 5.0, .melting = 350.0, .meltingRange = 40.0, .latent = 2e4};

/// A block of closest packing whose particles touch, with layers across y, at rest.
Particles packedBlock(const Material& material, std::size_t layers) {
    Particles particles;
    const double rest = 2.0 * material.radius;
    for (std::size_t layer = 0; layer < layers; ++layer)
        for (int row = -8; row <= 8; ++row)
            for (int k = -8; k <= 8; ++k) {
                const auto shift = static_cast<double>(layer % 3);
                append(particles, {.position = rest * Vec3(k + 0.5 * row + 0.5 * shift,
                                                           std::sqrt(2.0 / 3.0) * static_cast<double>(layer),
                                                           std::sqrt(0.75) * row + shift * std::sqrt(3.0) / 6.0),
                                   .radius = material.radius,
                                   .mass = material.mass,
                                   .enthalpy = material.mass * enthalpyAt(material.thermal, 300.0)});
            }
    return particles;
}

HeatNetwork networkOf(const Material& material, const Particles& particles, const HeatSetup& heat,
                      const Obstacles& obstacles = {}) {
    ForceEvaluator evaluator({.materials = {material}, .gravity = Vec3::Zero(), .obstacles = obstacles},
                             ForceMethod::grid);
    HeatNetwork network;
    std::vector<double> temperature(particles.count());
    for (std::size_t p = 0; p < temperature.size(); ++p) temperature[p] = temperatureOf({material}, particles, p);
    const PairTraversal& pairs = evaluator.preparePairs(particles);
    findFlows(pairs, particles, obstacles, heat, temperature, 0.0, network);
    findLinks(pairs, particles, network);
    return network;
}

Material conducting() {
    Material material = *materialPreset("liquid");
    material.radius = 0.02;
    material.mass = 0.05;
    material.thermal = kPlain;
    return material;
}

/// The particle nearest to the middle of all.
std::size_t middleOf(const Particles& particles) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& position : particles.position) mean += position / static_cast<double>(particles.count());
    const auto distance = [&](const Vec3& position) { return squaredLength(position - mean); };
    return static_cast<std::size_t>(std::ranges::min_element(particles.position, {}, distance) -
                                    particles.position.begin());
}

}  // namespace

TEST_CASE("Temperature and enthalpy are each other's inverse, also while melting", "[heat]") {
    for (const Thermal& thermal : {kPlain, kMelting, kSoftening}) {
        double before = -1.0;
        for (double temperature = 0.0; temperature < 600.0; temperature += 0.7) {
            const double enthalpy = enthalpyAt(thermal, temperature);
            CHECK(enthalpy > before);
            CHECK(temperatureAt(thermal, enthalpy) == Approx(temperature).epsilon(1e-14));
            // By a difference across 2 J/kg, unless a kink lies in it.
            const double slope =
                0.5 * (temperatureAt(thermal, enthalpy + 1.0) - temperatureAt(thermal, enthalpy - 1.0));
            if (std::abs(temperature - 350.0) > 0.1 && std::abs(temperature - 390.0) > 0.1)
                CHECK(warming(thermal, enthalpy) == Approx(slope).epsilon(1e-8));
            before = enthalpy;
        }
    }
}

TEST_CASE("The melted share goes from 0 to 1 over the latent heat", "[heat]") {
    const double solid = enthalpyAt(kMelting, 350.0);
    CHECK(solid == 350e3);
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        CHECK(meltedShare(kMelting, solid + share * 2e4) == Approx(share).margin(1e-15));
        CHECK(temperatureAt(kMelting, solid + share * 2e4) == Approx(350.0));
    }
    CHECK(meltedShare(kMelting, enthalpyAt(kMelting, 351.0)) == 1.0);
    CHECK(meltedShare(kSoftening, enthalpyAt(kSoftening, 360.0)) == Approx(0.25));
    CHECK(meltedShare(kPlain, 1e9) == 0.0);
}

TEST_CASE("The temperatures of two particles come together exponentially", "[heat]") {
    // k (1/C + 1/C) = 2 * 4 W/K / 1000 J/K.
    const auto differenceAfter = [](double seconds, int steps) {
        Bodies pair(kPlain);
        pair.add(400.0);
        pair.add(300.0);
        pair.connect([](std::size_t p) { return Links{{1 - p, 4.0}}; });
        const double heat = pair.heat();
        for (int k = 0; k < steps; ++k) CHECK(pair.exchange(seconds / steps) == 0.0);
        CHECK(pair.heat() == Approx(heat).epsilon(1e-15));
        return pair.temperature(0) - pair.temperature(1);
    };
    const double exact = 100.0 * std::exp(-0.008 * 100.0);
    const double coarse = differenceAfter(100.0, 50) - exact;
    const double fine = differenceAfter(100.0, 100) - exact;
    CHECK(std::abs(fine) < 0.0034 * exact);             // half of 0.8 times 0.008, the rate times a step
    CHECK(coarse / fine == Approx(2.0).epsilon(0.05));  // of first order
}

TEST_CASE("A wave in a ring decays as the steps of either method say", "[heat]") {
    constexpr std::size_t kCount = 24;
    const double conductance = 3.0;
    // (2 - 2 cos(2 pi/24)) k/C
    const double rate = (2.0 - 2.0 * std::cos(2.0 * std::numbers::pi / kCount)) * conductance / 1000.0;
    for (const double seconds : {50.0, 20000.0}) {
        INFO(seconds);
        Bodies ring(kPlain);
        for (std::size_t p = 0; p < kCount; ++p)
            ring.add(300.0 + 10.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(p) / kCount));
        ring.connect([&](std::size_t p) { return neighborsInRing(p, kCount, conductance); });
        const double heat = ring.heat();
        ring.exchange(seconds);
        const bool isExplicit = seconds * 2.0 * conductance / 1000.0 <= kExplicitShare;
        CHECK(isExplicit == (seconds < 100.0));
        const double factor = isExplicit ? 1.0 - rate * seconds : 1.0 / (1.0 + rate * seconds);
        for (std::size_t p = 0; p < kCount; ++p) {
            const double wave = std::cos(2.0 * std::numbers::pi * static_cast<double>(p) / kCount);
            CHECK(ring.temperature(p) == Approx(300.0 + 10.0 * factor * wave).margin(2e-6));
        }
        CHECK(ring.heat() == Approx(heat).epsilon(1e-14));
    }
}

TEST_CASE("A melting front moves as Stefan's solution", "[heat]") {
    // Ice of one temperature, Tm, whose end is kept at Tm + 50 K: the front is at 2 lambda sqrt(alpha t), where lambda
    // solves lambda exp(lambda^2) erf(lambda) = St / sqrt(pi), St = c 50 K / L = 2.5.
    double low = 0.0;
    double high = 2.0;
    for (int k = 0; k < 60; ++k) {
        const double lambda = 0.5 * (low + high);
        const bool isLow = lambda * std::exp(lambda * lambda) * std::erf(lambda) < 2.5 / std::sqrt(std::numbers::pi);
        (isLow ? low : high) = lambda;
    }
    CHECK(low == Approx(0.9).margin(0.05));
    // Layers of 1 m^2 and 1 mm of 1 kg, so that alpha = k d / (rho c d) with k = conductance * d.
    constexpr std::size_t kLayers = 40;
    const double conductance = 5.0 / 1e-3;
    const double alpha = 5.0 / (1e3 * 1000.0);
    const double seconds = std::pow(20e-3 / (2.0 * low), 2.0) / alpha;  // until 20 layers have melted
    for (const int steps : {400, 20}) {                                 // explicit would take 4 steps a second
        INFO(steps);
        Bodies slab(kMelting);
        for (std::size_t p = 0; p < kLayers; ++p) slab.add(350.0);
        slab.connect([&](std::size_t p) { return neighborsInChain(p, kLayers, conductance); });
        slab.connectToOutside(0, 2.0 * conductance, 400.0);
        const double before = slab.heat();
        double given = 0.0;
        double front = 0.0;
        for (int k = 0; k < steps; ++k) given += slab.exchange(seconds / steps);
        for (std::size_t p = 0; p < kLayers; ++p) front += meltedShare(kMelting, slab.particles.enthalpy[p]);
        CHECK(front == Approx(20.0).epsilon(steps == 400 ? 0.01 : 0.1));
        CHECK(slab.heat() - before == Approx(given).epsilon(1e-9));
    }
}

TEST_CASE("No temperature leaves the range of all, and none of the heat is lost", "[heat]") {
    for (const Thermal& thermal : {kPlain, kMelting, kSoftening})
        for (const double seconds : {1.0, 1e3, 1e6}) {
            Bodies bodies(thermal);
            std::uint64_t seed = 5;
            const auto draw = [&] {
                seed = seed * 6364136223846793005U + 1442695040888963407U;
                return static_cast<double>(seed >> 40U) / static_cast<double>(1U << 24U);
            };
            constexpr std::size_t kCount = 60;
            for (std::size_t p = 0; p < kCount; ++p) bodies.add(300.0 + 100.0 * draw());
            std::vector<Links> links(kCount);
            for (std::size_t p = 0; p < kCount; ++p)
                for (int k = 0; k < 4; ++k) {
                    const auto other = static_cast<std::size_t>(draw() * kCount);
                    if (other == p) continue;
                    const double conductance = std::pow(10.0, 4.0 * draw() - 2.0);
                    links[p].emplace_back(other, conductance);
                    links[other].emplace_back(p, conductance);
                }
            bodies.connect([&](std::size_t p) { return links[p]; });
            bodies.connectToOutside(3, 20.0, 280.0);
            bodies.connectToOutside(7, 20.0, 420.0);
            const double before = bodies.heat();
            const double given = bodies.exchange(seconds);
            INFO("melts at " << thermal.melting << " K, " << seconds << " s");
            CHECK(bodies.heat() - before == Approx(given).margin(1e-11 * before));
            for (std::size_t p = 0; p < kCount; ++p) {
                CHECK(bodies.temperature(p) > 280.0 - 2e-6);
                CHECK(bodies.temperature(p) < 420.0 + 2e-6);
            }
        }
}

TEST_CASE("Closest packing conducts as the material does, along every axis", "[heat]") {
    const Material material = conducting();
    const Particles particles = packedBlock(material, 9);
    const HeatNetwork network = networkOf(material, particles, {});
    const std::size_t p = middleOf(particles);
    const double rest = 2.0 * material.radius;
    const double volume = rest * rest * rest / std::sqrt(2.0);
    CHECK(network.begin[p + 1] - network.begin[p] == 18);
    for (int axis = 0; axis < 3; ++axis) {
        double sum = 0.0;
        for (std::size_t link = network.begin[p]; link < network.begin[p + 1]; ++link) {
            const double along = particles.position[network.other[link]][axis] - particles.position[p][axis];
            sum += network.conductance[link] * along * along;
        }
        CHECK(sum / (2.0 * volume) == Approx(kPlain.conductivity).epsilon(1e-9));
    }
}

TEST_CASE("Links conduct the same in both directions, between materials by the harmonic mean", "[heat]") {
    Material good = conducting();
    Material poor = conducting();
    poor.thermal.conductivity = 1.0;
    Particles particles = clouds::strewn(300, 0.15);
    for (std::size_t p = 0; p < particles.count(); ++p) {
        particles.radius[p] = 0.02;
        particles.material[p] = static_cast<std::uint32_t>(p % 2);
        particles.enthalpy.push_back(1e5);
    }
    ForceEvaluator evaluator({.materials = {good, poor}, .gravity = Vec3::Zero(), .obstacles = {}}, ForceMethod::grid);
    HeatNetwork network;
    const std::vector<double> temperature(particles.count(), 300.0);
    const PairTraversal& pairs = evaluator.preparePairs(particles);
    findFlows(pairs, particles, {}, {}, temperature, 0.0, network);
    findLinks(pairs, particles, network);
    std::size_t mixed = 0;
    for (std::uint32_t p = 0; p < particles.count(); ++p)
        for (std::size_t link = network.begin[p]; link < network.begin[p + 1]; ++link) {
            const std::uint32_t other = network.other[link];
            const auto back =
                std::find(network.other.begin() + static_cast<std::ptrdiff_t>(network.begin[other]),
                          network.other.begin() + static_cast<std::ptrdiff_t>(network.begin[other + 1]), p);
            REQUIRE(back != network.other.begin() + static_cast<std::ptrdiff_t>(network.begin[other + 1]));
            CHECK(network.conductance[link] ==
                  network.conductance[static_cast<std::size_t>(back - network.other.begin())]);
            const double ratio = std::sqrt(squaredLength(particles.position[p] - particles.position[other])) / 0.04;
            const double mean = p % 2 == other % 2 ? (p % 2 == 0 ? 5.0 : 1.0) : 2.0 * 5.0 / 6.0;
            CHECK(network.conductance[link] == Approx(mean * 0.04 * conductanceAt(ratio)).margin(1e-12));
            mixed += p % 2 == other % 2 ? 0U : 1U;
        }
    CHECK(mixed > 100);
}

TEST_CASE("A slab between two plates gets a straight profile, and passes the heat that it should", "[heat][threads]") {
    const Material material = conducting();
    constexpr std::size_t kLayers = 8;
    Particles particles = packedBlock(material, kLayers);
    const double rise = std::sqrt(2.0 / 3.0) * 2.0 * material.radius;
    const double top = rise * (kLayers - 1);
    Obstacles obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.shapes = {Plane{Vec3(0, -material.radius, 0), Vec3::UnitY()},
                        Plane{Vec3(0, top + material.radius, 0), -Vec3::UnitY()}};
    HeatSetup heat;
    heat.obstacles = {400.0, 300.0};
    const HeatNetwork network = networkOf(material, particles, heat, obstacles);
    HeatScratch scratch;
    const ShareNumbers share = [](const auto& own, auto& combined) { combined = own; };
    exchangeHeat(network, {material}, Ranks::alone(), share, 1e7, particles, scratch);  // to the steady state
    const double thickness = top + 2.0 * material.radius;
    const double area = 2.0 * std::sqrt(3.0) * material.radius * material.radius;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        // At the rim, where layers do not lie above each other, heat flows sideways.
        if (std::hypot(particles.position[p].x(), particles.position[p].z()) > 4.0 * material.radius) continue;
        const double height = particles.position[p].y() + material.radius;
        const double temperature = temperatureOf({material}, particles, p);
        CHECK(temperature == Approx(400.0 - 100.0 * height / thickness).margin(0.05));
        if (height < 1.5 * material.radius)
            CHECK(network.inflow[p] - network.conductanceOutside[p] * temperature ==
                  Approx(kPlain.conductivity * area * 100.0 / thickness).epsilon(0.005));
    }
}

TEST_CASE("An explicit exchange is the same with and without links", "[heat]") {
    const Material material = conducting();
    std::vector<Material> materials = {material, material};
    materials[1].thermal.conductivity = 50.0;
    Particles particles = packedBlock(material, 5);
    std::vector<double> temperature;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        particles.material[p] = p % 3 == 0 ? 1 : 0;
        temperature.push_back(300.0 + static_cast<double>(p * p % 37));
        particles.enthalpy[p] = material.mass * enthalpyAt(kPlain, temperature[p]);
    }
    HeatSetup heat;
    heat.air = {.temperature = 280.0, .exchange = 10.0};
    ForceEvaluator evaluator({.materials = materials, .gravity = Vec3::Zero(), .obstacles = {}}, ForceMethod::grid);
    const PairTraversal& pairs = evaluator.preparePairs(particles);
    HeatNetwork flows;
    findFlows(pairs, particles, {}, heat, temperature, 0.0, flows);
    HeatNetwork network = flows;
    findLinks(pairs, particles, network);
    CHECK_FALSE(flows.hasLinks());
    REQUIRE(network.hasLinks());
    constexpr double kSeconds = 1.0;
    REQUIRE(isExplicit(flows, materials, Ranks::alone(), kSeconds, particles));
    const ShareNumbers share = [](const auto& own, auto& combined) { combined = own; };
    Particles again = particles;
    HeatScratch scratch;
    const double given = exchangeHeat(network, materials, Ranks::alone(), share, kSeconds, particles, scratch);
    CHECK(exchangeHeat(flows, materials, Ranks::alone(), share, kSeconds, again, scratch) == given);
    double largest = 0.0;
    double moved = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        // Temperatures that follow from enthalpies differ by rounding from those given.
        largest = std::max(largest, std::abs(again.enthalpy[p] - particles.enthalpy[p]));
        moved = std::max(moved, std::abs(particles.enthalpy[p] - material.mass * enthalpyAt(kPlain, temperature[p])));
    }
    CHECK(moved > 1.0);
    // Each temperature is rounded by half an epsilon, of which an explicit exchange passes on less than all, and each
    // enthalpy by as much.
    CHECK(largest < 4.0 * std::numeric_limits<double>::epsilon() * material.mass * enthalpyAt(kPlain, 400.0));
}

TEST_CASE("The air meets the free surface alone, at any density", "[heat]") {
    const Material material = conducting();
    HeatSetup heat;
    heat.air = {.temperature = 280.0, .exchange = 10.0};
    for (const double scale : {1.0, 0.94, 1.06}) {
        INFO("distances times " << scale);
        Particles particles = packedBlock(material, 9);
        for (Vec3& position : particles.position) position *= scale;
        const HeatNetwork network = networkOf(material, particles, heat);
        const std::size_t middle = middleOf(particles);
        CHECK(network.conductanceOutside[middle] < 1e-12);
        // The particle above it in the topmost layer.
        std::size_t onTop = middle;
        for (std::size_t p = 0; p < particles.count(); ++p) {
            const Vec3 away = particles.position[p] - particles.position[middle];
            if (away.y() > 3.9 * std::sqrt(2.0 / 3.0) * 2.0 * material.radius * scale &&
                std::hypot(away.x(), away.z()) < 1.3 * material.radius)
                onTop = p;
        }
        REQUIRE(onTop != middle);
        const double area = 2.0 * std::sqrt(3.0) * material.radius * material.radius;
        // What a denser or looser surface has of it depends on the weights of its neighbors.
        CHECK(network.conductanceOutside[onTop] == Approx(10.0 * area).epsilon(scale == 1.0 ? 1e-6 : 0.35));
    }
    Particles lone;
    append(lone, {.radius = material.radius, .mass = material.mass, .enthalpy = 1e4});
    const double whole = 4.0 * std::numbers::pi * material.radius * material.radius;
    CHECK(networkOf(material, lone, heat).conductanceOutside[0] == Approx(10.0 * whole));
}

TEST_CASE("A lone particle radiates as a gray body", "[heat]") {
    const Material material = conducting();
    HeatSetup heat;
    heat.air = {.temperature = 300.0, .exchange = 0.0, .emissivity = 0.8};
    Particles lone;
    append(lone,
           {.radius = material.radius, .mass = material.mass, .enthalpy = material.mass * enthalpyAt(kPlain, 1200.0)});
    const HeatNetwork network = networkOf(material, lone, heat);
    const double area = 4.0 * std::numbers::pi * material.radius * material.radius;
    const double power = 0.8 * kStefanBoltzmann * area * (std::pow(1200.0, 4.0) - std::pow(300.0, 4.0));
    CHECK(network.conductanceOutside[0] * 1200.0 - network.inflow[0] == Approx(power));
}
