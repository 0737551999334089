// The table of all observables of the stability study, and the variants of a scene as overrides of its keys.
#include "scenes/model/study.h"

#include <sstream>

namespace scenes {

const std::vector<ObservableInfo>& observables() {
    static const std::vector<ObservableInfo> kObservables = {
        {Observable::pairLaw, "pair-law", "", false,
         "relative difference of the work of the pair force from the cutoff and its energy, over all pairs of "
         "materials"},
        {Observable::momentumDrift, "momentum-drift", "", false,
         "change of linear or angular momentum, relative to the sum of |p| or |x x p| at the start"},
        {Observable::energyRise, "energy-rise", "", false,
         "largest rise of the energy per step between frames, relative to the kinetic energy, in a closed scene"},
        {Observable::positionError, "position-error", "r", true,
         "root mean square position error of the particles at the end, against the reference"},
        {Observable::heightError, "height-error", "r", true,
         "largest height error of the heaviest particle over the frames, against the reference"},
        {Observable::frontError, "front-error", "r", true,
         "largest error of the largest x of all particles over the frames, against the reference"},
        {Observable::radiusError, "radius-error", "r", true,
         "largest error of the radius that holds 90 % of the particles over the frames, against the reference"},
        {Observable::statisticsError, "statistics-error", "", true,
         "relative error of center of mass, radius of gyration, R90 and z90 at the end, against the reference"},
        {Observable::reboundError, "rebound-error", "", true,
         "relative error of the largest upward speed of the center of mass, against the reference"},
        {Observable::restitutionError, "restitution-error", "", true,
         "largest relative error over the particles of the speed that remains at the end, against the reference"},
        {Observable::largestSpeed, "largest-speed", "m/s", false, "largest speed of any particle in any frame"},
        {Observable::medianSpeed, "median-speed", "m/s", false, "median speed of the particles at the end"},
        {Observable::fragments, "fragments", "", false, "particles that left the largest cluster by the end"},
        {Observable::spacing, "spacing", "", false,
         "mean distance of nearest neighbors at the end, relative to the lattice ball of least energy"},
        {Observable::passed, "passed", "", false, "particles on the wrong side of an obstacle at the end"},
        {Observable::penetration, "penetration", "r", false,
         "deepest that a particle lies in an obstacle at the end of any frame: its center is beyond the surface above "
         "1"},
        {Observable::refusals, "refusals", "", false,
         "emissions that were due while another particle blocked the site"},
        {Observable::stepBound, "step-bound", "", false,
         "step bound relative to the largest stable step at the end, for the explicit stepper"},
        {Observable::order, "order", "", false, "order of convergence at the step, its half and its quarter"},
        {Observable::cost, "cost", "", false,
         "time of the run relative to velocity Verlet at nine tenths of its step bound"},
    };
    return kObservables;
}

const ObservableInfo& infoOf(Observable observable) {
    return observables().at(static_cast<std::size_t>(observable));
}

Overrides overridesOf(std::string_view variant) {
    Overrides overrides;
    std::istringstream assignments{std::string(variant)};
    for (std::string assignment; std::getline(assignments, assignment, ';');) {
        assignment.erase(0, assignment.find_first_not_of(' '));
        if (!assignment.empty()) overrides.emplace_back(assignment);
    }
    return overrides;
}

std::vector<std::string> variantsOf(const Study& study, bool isQuick) {
    const std::vector<std::string>& wanted = isQuick && !study.quick.empty() ? study.quick : study.vary;
    return wanted.empty() ? std::vector<std::string>{""} : wanted;
}

}  // namespace scenes
