// Step doubling on two copies of the state.
#include "engine/local_error.h"

#include <cmath>

#include "engine/steppers.h"

namespace engine {

double localError(const Simulation& simulation, double h) {
    const std::size_t count = simulation.particles.count();
    if (count == 0) return 0.0;
    Simulation whole = simulation;
    takeStep(whole, h);
    Simulation halves = simulation;
    takeStep(halves, 0.5 * h);
    takeStep(halves, 0.5 * h);

    double sumSq = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const double radius = simulation.particles.radius[p];
        sumSq += squaredLength(whole.particles.position[p] - halves.particles.position[p]) / (radius * radius);
    }
    const double difference = std::sqrt(sumSq / static_cast<double>(count));
    return difference / (1.0 - std::exp2(-orderOf(simulation.stepper))) / h;
}

}  // namespace engine
