// The observables by name, and variants as overrides.
#include "scenes/schema/study.h"

#include <algorithm>

namespace scenes {

const std::vector<ObservableInfo>& observables() {
    static const std::vector<ObservableInfo> kObservables = {
        {Observable::pairLaw, "pair-law", "", false,
         "work of the pair force from the cutoff against its energy, relative: over all pairs of materials"},
        {Observable::momentumDrift, "momentum-drift", "", false,
         "change of linear or angular momentum in units of the sum of |p| or |x x p| at the start"},
        {Observable::energyRise, "energy-rise", "", false,
         "largest rise of the energy between frames, a step, over the kinetic energy, in a closed scene"},
        {Observable::positionError, "position-error", "r", true,
         "root mean square over the particles at the end, against the reference"},
        {Observable::heightError, "height-error", "r", true,
         "of the heaviest particle, the largest over the frames, against the reference"},
        {Observable::frontError, "front-error", "r", true,
         "of the largest x of all particles, the largest over the frames, against the reference"},
        {Observable::radiusError, "radius-error", "r", true,
         "of the radius that holds 90 % of the particles, the largest over the frames, against the reference"},
        {Observable::statisticsError, "statistics-error", "", true,
         "relative, of center of mass, radius of gyration, R90 and z90 at the end, against the reference"},
        {Observable::reboundError, "rebound-error", "", true,
         "relative, of the fastest rise of the center of mass, against the reference"},
        {Observable::restitutionError, "restitution-error", "", true,
         "relative, of the speed left at the end, the worst particle, against the reference"},
        {Observable::largestSpeed, "largest-speed", "m/s", false, "of any particle in any frame"},
        {Observable::medianSpeed, "median-speed", "m/s", false,
         "half of the particles are slower than this at the end"},
        {Observable::fragments, "fragments", "", false, "particles that left the largest cluster by the end"},
        {Observable::spacing, "spacing", "", false,
         "mean distance of nearest neighbors at the end over that of the lattice ball of least energy"},
        {Observable::passed, "passed", "", false, "particles on the wrong side of an obstacle at the end"},
        {Observable::refusals, "refusals", "", false, "births that found their place taken when they were due"},
        {Observable::stepBound, "step-bound", "", false,
         "step bound over the largest stable step at the end, for the explicit stepper"},
        {Observable::order, "order", "", false, "of convergence at the step, its half and its quarter"},
        {Observable::cost, "cost", "", false,
         "time of the run over that of velocity Verlet at nine tenths of its step bound"},
    };
    return kObservables;
}

const ObservableInfo& infoOf(Observable observable) {
    return observables().at(static_cast<std::size_t>(observable));
}

Overrides overridesOf(std::string_view variant) {
    Overrides overrides;
    while (!variant.empty()) {
        const std::size_t end = variant.find(';');
        std::string_view part = variant.substr(0, end);
        part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
        if (!part.empty()) overrides.emplace_back(std::string(part));
        variant = end == std::string_view::npos ? std::string_view{} : variant.substr(end + 1);
    }
    return overrides;
}

std::vector<std::string> variantsOf(const Study& study, bool quick) {
    const std::vector<std::string>& wanted = quick && !study.quick.empty() ? study.quick : study.vary;
    return wanted.empty() ? std::vector<std::string>{""} : wanted;
}

}  // namespace scenes
