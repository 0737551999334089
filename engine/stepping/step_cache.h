// What one step leaves for the next: forces, energy, the neighbor list, and memory that is used again. Part of every
// Simulation, and of no use outside the engine. A run that is resumed without it, or after invalidate(), goes on with
// the same motion; only the bits may differ, because sums over pairs run in the order of the neighbor list.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/scratch.h"
#include "engine/forces/conjugate_gradient.h"
#include "engine/forces/forces.h"
#include "engine/state/simulation.h"

namespace engine {

/// Memory of the implicit steppers.
struct ImplicitScratch {
    PairMatrix matrix;
    SolverScratch solver;
    std::vector<Vec3> rightHandSide;  ///< N s, in the matrix's order
    std::vector<Vec3> change;         ///< half the change of velocity, m/s, in the matrix's order
};

struct StepCache {
    ForceEvaluator evaluator;  ///< with the neighbor list

    std::vector<Vec3> forces;  ///< of pairs and gravity, N; those that the next step starts with if forcesCurrent
    bool forcesCurrent = false;
    std::optional<double> energy;  ///< after the last step as the audit counts it, J; see step_audit.h
    double kinetic = 0.0;          ///< the kinetic share of it, J

    /// Distance from each particle's surface to the nearest obstacle that is certain as long as steps alone move it, m;
    /// empty where nothing is known.
    std::vector<double> clearance;
    std::vector<std::uint8_t> swept;  ///< whether obstacles meet the particle along its way in this step, 0 or 1

    Scratch<std::vector<Vec3>> startPositions;  ///< at the step's start, m
    double startCutoff = 0.0;                   ///< cutoff of the pairs at startPositions, m
    bool startIsListed = false;                 ///< whether the neighbor list covers startPositions within startCutoff
    /// For each particle near obstacles the neighbor found last, where the next search begins.
    Scratch<std::vector<std::uint32_t>> cachedNeighbors;

    Scratch<std::vector<Vec3>> predictedVelocities;  ///< velocity Verlet's, m/s
    Scratch<ImplicitScratch> implicit;

    /// RMS over the mass of the acceleration that the implicit steppers' solver may leave out, m/s^2. Set by the
    /// automatic stepper whenever it runs one of them.
    double toleratedAcceleration = 0.0;

    /// To be called after particles were removed or changed by anything but a step: all that was known by index or by
    /// position is forgotten. The memory and the tolerance stay.
    void invalidate();
};

}  // namespace engine
