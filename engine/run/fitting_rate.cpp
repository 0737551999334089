// Emits into empty space, and counts what finds room once the stream is steady.
#include "engine/run/fitting_rate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/state/emitters.h"
#include "engine/state/simulation.h"
#include "engine/stepping/population.h"

namespace engine {
namespace {

/// How long the stream is watched, in intervals or times of clearing: first until it is steady, then while it is
/// counted. Chosen: shares repeat within a few percent.
constexpr double kSettling = 4.0;
constexpr double kCounting = 12.0;

/// Least number of particles that are to be asked for while they are counted. Chosen: for random picks.
constexpr double kLeastAsked = 300.0;

/// Most moments of emission that are tried, and most particles that are emitted. Chosen: a second or two.
constexpr int kMostMoments = 20000;
constexpr std::uint64_t kMostParticles = 200000;

/// Lets all particles fly freely for some time, s.
void fly(Simulation& simulation, double seconds) {
    Particles& particles = simulation.particles;
    const Vec3& gravity = simulation.setup.gravity;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        particles.position[p] += seconds * particles.velocity[p] + 0.5 * seconds * seconds * gravity;
        particles.velocity[p] += seconds * gravity;
    }
    simulation.time += seconds;
}

/// An emitter alone in empty space, which emits without end.
Simulation aloneInSpace(const Setup& setup, std::size_t index) {
    Simulation simulation;
    simulation.setup.materials = setup.materials;
    simulation.setup.gravity = setup.gravity;
    simulation.setup.seed = setup.seed;
    Emitter emitter = setup.emitters[index];
    emitter.start = 0.0;
    emitter.until = std::numeric_limits<double>::infinity();
    emitter.limit = std::numeric_limits<std::uint64_t>::max();
    simulation.setup.emitters = {emitter};
    simulation.emitters = {initialState(emitter)};
    return simulation;
}

}  // namespace

double fittingShare(const Setup& setup, std::size_t index) {
    Simulation simulation = aloneInSpace(setup, index);
    const Emitter& emitter = simulation.setup.emitters[0];
    if (emitter.clearance == 0.0) return 1.0;
    const double clearing = clearingTime(emitter, setup.gravity, setup.materials[emitter.material].radius);
    const double emissions = static_cast<double>(simulation.emitters[0].schedules.size());
    const double askedPerSecond = emissions * static_cast<double>(emitter.cluster.size()) / emitter.interval;
    const double period = std::isfinite(clearing) ? std::max(emitter.interval, clearing) : emitter.interval;
    const double settled = kSettling * period;
    const double end = settled + std::max(kCounting * period, kLeastAsked / askedPerSecond);
    double bornBefore = 0.0;
    double askedBefore = 0.0;
    const auto asked = [&] { return static_cast<double>(askedCount(emitter, simulation.time)); };
    const auto born = [&] { return static_cast<double>(birthCount(simulation)); };
    for (int moment = 0; moment < kMostMoments && birthCount(simulation) < kMostParticles; ++moment) {
        emitDue(simulation);
        const double next = nextEmission(simulation);
        if (simulation.time <= settled) {
            bornBefore = born();
            askedBefore = asked();
        }
        if (!(next < end)) break;
        fly(simulation, next - simulation.time);
        simulation.time = next;
        // Particles that left the nozzle long ago block no emission.
        keepWhere(simulation.particles, [&](std::size_t p) {
            return !std::isfinite(clearing) ||
                   simulation.time - simulation.particles.birthTime[p] < kSettling * clearing;
        });
    }
    return asked() > askedBefore ? std::min(1.0, (born() - bornBefore) / (asked() - askedBefore)) : 1.0;
}

}  // namespace engine
