// Calls the function of the stepper in use between the kicks of the fields, and has the tables of names and orders. The
// work that fields do is the change of kinetic energy, which is known exactly: the audit needs no potential, and drag,
// boxes and switching count like everything else.
#include "engine/stepping/take_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/implicit_step.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/symplectic_euler.h"
#include "engine/stepping/velocity_verlet.h"

namespace engine {
namespace {

struct NameAndOrder {
    std::string_view name;
    int order;
};

/// Names and orders of convergence of the steppers, by StepperKind.
constexpr std::array<NameAndOrder, kSteppers.size()> kNamesAndOrders = {{
    {"symplectic-euler", 1},
    {"velocity-verlet", 2},
    {"leapfrog", 1},
    {"implicit-damping", 2},
    {"linearly-implicit", 2},
    {"auto", 2},
}};

/// Names of what limits a step, by StepLimit.
constexpr std::array<std::string_view, kStepLimits> kLimitNames = {"given step", "wanted error", "displacement limit",
                                                                   "energy audit", "frame"};

/// A step without the fields.
void takeInnerStep(Simulation& simulation, double h) {
    switch (simulation.stepper) {
        case StepperKind::symplecticEuler:
            symplecticEulerStep(simulation, h);
            return;
        case StepperKind::velocityVerlet:
            return velocityVerletStep(simulation, h, kWholeStep);
        case StepperKind::leapfrog:
            return velocityVerletStep(simulation, h, kHalfStep);
        case StepperKind::implicitDamping:
            return implicitStep(simulation, h, {.damping = 0.5 * h, .stiffness = 0.0});
        case StepperKind::linearlyImplicit:
            return implicitStep(simulation, h, {.damping = 0.5 * h, .stiffness = 0.25 * h * h});
        case StepperKind::automatic:
            break;  // the automatic stepper chooses one of the others for each step
    }
}

std::vector<FieldKick> kicksBetween(const std::vector<Field>& fields, double from, double to) {
    std::vector<FieldKick> kicks;
    for (const Field& field : fields)
        if (const FieldKick kick(field, from, to); kick.exists()) kicks.push_back(kick);
    return kicks;
}

/// What kicks have done to the particles of all ranks.
struct KickSums {
    double gain = 0.0;          ///< of kinetic energy, J
    double differenceSq = 0.0;  ///< sum of the squared differences to the kicks before, (radii per second)^2
};

/// Applies kicks one after another, and records what they change in the step cache. The sums are left out if the steps
/// are not audited.
KickSums kickAll(Simulation& simulation, const std::vector<FieldKick>& kicks) {
    Particles& particles = simulation.particles;
    std::vector<Vec3>& changes = simulation.cache->fieldChanges;
    changes.resize(particles.count(), Vec3::Zero());
    const auto kickOne = [&](std::size_t p) {
        const Vec3 before = particles.velocity[p];
        Vec3 after = before;
        for (const FieldKick& kick : kicks) after = kick.velocityAfter(particles.position[p], after);
        particles.velocity[p] = after;
        const Vec3 change = after - before;
        const double differenceSq = squaredLength(change - changes[p]) / (particles.radius[p] * particles.radius[p]);
        changes[p] = change;
        return std::array{0.5 * particles.mass[p] * dot(change, after + before), differenceSq};
    };
    if (simulation.cache->energy) {
        const auto [gain, differenceSq] = exactSums<2>(*simulation.ranks, particles.count(), kickOne);
        return {gain, differenceSq};
    }
    inParallel(particles.count(), kParticleGrain, [&](std::size_t p) { kickOne(p); });
    return {};
}

}  // namespace

void takeStep(Simulation& simulation, double h) {
    kickBefore(simulation, h);
    takeInnerStep(simulation, h);
    kickAfter(simulation, h);
}

void kickBefore(Simulation& simulation, double h) {
    const double from = simulation.time;
    const std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from, from + 0.5 * h);
    std::vector<Vec3>& changes = simulation.cache->fieldChanges;
    changes.clear();
    if (!kicks.empty()) simulation.cache->work += kickAll(simulation, kicks).gain;
}

void kickAfter(Simulation& simulation, double h) {
    StepCache& cache = *simulation.cache;
    if (cache.energy && std::isnan(*cache.energy)) return;  // the step is rejected
    const double from = simulation.time;
    std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from + 0.5 * h, from + h);
    if (kicks.empty()) return;
    std::reverse(kicks.begin(), kicks.end());  // in the mirrored order, so that the step is symmetric in time
    const auto [gain, differenceSq] = kickAll(simulation, kicks);
    cache.work += gain;
    if (!cache.energy || !isVerlet(simulation.stepper)) return;
    *cache.energy += gain;
    cache.kinetic += gain;
    cache.workAtEnergy += gain;
    cache.predictionError +=
        std::sqrt(differenceSq / static_cast<double>(std::max<std::uint64_t>(1, countOfAll(simulation))));
}

std::string_view nameOf(StepperKind stepper) {
    return kNamesAndOrders[static_cast<std::size_t>(stepper)].name;
}

std::string_view nameOf(StepLimit limit) {
    return kLimitNames[static_cast<std::size_t>(limit)];
}

int orderOf(StepperKind stepper) {
    return kNamesAndOrders[static_cast<std::size_t>(stepper)].order;
}

double errorRatio(StepperKind stepper, double stepRatio) {
    return orderOf(stepper) == 1 ? stepRatio : stepRatio * stepRatio;
}

double stepRatio(StepperKind stepper, double errorRatio) {
    return orderOf(stepper) == 1 ? errorRatio : std::sqrt(errorRatio);
}

}  // namespace engine
