// Data that one time step leaves for the next: forces, energy, the neighbor list, and memory to be used again. Part of
// every Simulation, used only inside the engine. A run that is resumed without these data, or after invalidate(),
// continues the same motion, but the last bits may differ, because sums over pairs run in the order of the neighbor
// list.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/scratch.h"
#include "engine/forces/conjugate_gradient.h"
#include "engine/forces/forces.h"
#include "engine/state/simulation.h"

namespace engine {

/// Matrix and vectors of the implicit steppers, kept so that their memory is used again.
struct ImplicitScratch {
    PairMatrix matrix;
    SolverScratch solver;
    std::vector<Vec3> rightHandSide;  ///< right-hand side of the linear system, in the matrix's order, N s
    std::vector<Vec3> change;         ///< half the change of velocities in a step, in the matrix's order, m/s
};

/// Energy of the motion that the particles of a group have in common, far from all others; see free_groups.h.
struct GroupEnergy {
    double kinetic = 0.0;    ///< of the center of mass, J
    double potential = 0.0;  ///< in gravity, J
};

struct StepCache {
    ForceEvaluator evaluator;  ///< force evaluator, which has the neighbor list

    std::vector<Vec3> forces;  ///< forces of pairs and gravity, N; valid for the next step if forcesCurrent
    bool forcesCurrent = false;
    std::optional<double> energy;            ///< total energy after the last step, J; see step_audit.h
    double kinetic = 0.0;                    ///< kinetic energy after the last step, J
    std::vector<GroupEnergy> groupEnergies;  ///< of the evaluator's groups, in the state of `energy`

    /// Lower bound on the distance from each particle's surface to the nearest obstacle, m. Valid as long as particles
    /// are moved by steps only; empty where nothing is known.
    std::vector<double> clearance;
    std::vector<std::uint8_t> swept;  ///< 1 if a particle's contact is swept in this step, else 0
    std::vector<std::uint8_t> held;   ///< how often each particle's center was held at a surface in this step

    Scratch<std::vector<Vec3>> startPositions;  ///< positions at the step's start, m
    bool startIsListed = false;                 ///< whether the neighbor list covers startPositions
    /// For each particle, another particle that was within the cutoff when this was last asked for, which is done near
    /// obstacles. The next search for such a particle begins with it.
    Scratch<std::vector<std::uint32_t>> cachedNeighbors;

    double surfaceSpeed = 0.0;            ///< upper bound on the speed of obstacles' surfaces in this step, m/s
    SharedLoads loads;                    ///< recorded in this step and not yet added up
    std::vector<ObstacleLoad> stepLoads;  ///< of the step that is not yet accepted
    /// Work on the particles by what is not part of their energy, such as obstacles in motion, since an arbitrary
    /// moment, J: the audit compares its change with that of the energy.
    double work = 0.0;
    double workAtEnergy = 0.0;  ///< the work when `energy` was recorded, J

    /// Energy less work after the last exchange of heat, or at the start of the interval, J; what is missing of it at
    /// the next exchange has become heat. Not used in a run without heat.
    double energyAtHeat = 0.0;

    double predictionError = 0.0;  ///< RMS of velocity Verlet's error in predicting velocities, radii per second
    /// Mean accelerations of the particles over the last step, m/s^2, and its length, s. For the steppers that estimate
    /// their error from their change; empty where the last step was taken back.
    std::vector<Vec3> meanAccelerations;
    double lastStep = 0.0;

    /// Change of each velocity by the fields before this step, m/s, by which velocity Verlet predicts their change
    /// after it; empty where no field acts.
    Scratch<std::vector<Vec3>> fieldChanges;
    Scratch<std::vector<Vec3>> predictedVelocities;  ///< velocities from which velocity Verlet computes damping, m/s
    Scratch<ImplicitScratch> implicit;

    /// Tolerance of the implicit steppers' solver as an acceleration: the mass-weighted RMS that it may leave out,
    /// m/s^2. Set by the automatic stepper before it runs an implicit stepper, otherwise 0.
    double toleratedAcceleration = 0.0;

    /// Marks as unknown everything that depends on the indices or the positions of the particles. To be called after
    /// particles were removed, or were changed by anything but a step.
    void invalidate();
};

}  // namespace engine
