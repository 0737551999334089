// The setup of a run: everything that a scene says about the motion. Filled in by scenes/ and read by all of the
// engine; it does not change once a run has started.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/force_law/material.h"
#include "engine/obstacles/obstacles.h"
#include "engine/state/emitters.h"
#include "engine/state/fields.h"
#include "engine/state/heat.h"
#include "engine/state/particles.h"

namespace engine {

enum class StepperKind {
    symplecticEuler,   ///< symplectic Euler, equations 7 and 8 of the paper, as printed
    velocityVerlet,    ///< velocity Verlet: second order; damping from the predicted velocity
    leapfrog,          ///< Groot-Warren modified velocity Verlet with lambda = 1/2: first order, stable at longer steps
    implicitDamping,   ///< implicit midpoint rule for damping: second order
    linearlyImplicit,  ///< linearized implicit midpoint rule for damping and stiffness: second order
    automatic          ///< the automatic choice of the cheapest stepper, except symplectic Euler, at a wanted error
};

/// Number of steppers that can take a step: all enumerators but the last, the automatic stepper, which chooses among
/// them.
inline constexpr std::size_t kStepperKinds = static_cast<std::size_t>(StepperKind::automatic);

/// Whether a stepper is a form of velocity Verlet. These steppers solve no linear system and know the energy at the end
/// of a step.
constexpr bool isVerlet(StepperKind stepper) {
    return stepper == StepperKind::velocityVerlet || stepper == StepperKind::leapfrog;
}

enum class ForceMethod {
    reference,  ///< all pairs, one after another, as in the paper
    grid        ///< pairs from a neighbor list, on all threads
};

/// Precision in which pair forces are computed; the state of a simulation is always in double.
enum class Precision { doubles, singles };

/// Everything that a scene says about the motion.
struct Setup {
    std::vector<Material> materials = {Material{}};
    Vec3 gravity = Vec3(0.0, -9.8, 0.0);  ///< m/s^2
    double drag = 0.0;                    ///< drag coefficient k, 1/s: free motion decays like exp(-k t)
    std::vector<Field> fields;
    Obstacles obstacles;
    std::optional<HeatSetup> heat;     ///< none for a run without heat
    double agitationInterval = 0.0;    ///< time between random impulses, s; 0 for a run without agitation
    std::optional<BoundingBox> world;  ///< bounds of the world; particles outside are removed
    std::vector<Emitter> emitters;
    Particles initial;  ///< particles at time zero
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.01;   ///< longest step, s; a frame is divided evenly; the automatic stepper does not use it
    double error = 1e-2;  ///< position error that the automatic stepper aims at, radii per second of motion
    double solverTolerance = 1e-4;  ///< relative residual at which the implicit steppers' solver stops
    ForceMethod forces = ForceMethod::grid;
    Precision precision = Precision::doubles;  ///< precision of the pair forces; see PairTraversal::hasLanes()
    std::uint64_t seed = 1;
};

}  // namespace engine
