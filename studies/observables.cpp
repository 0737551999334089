// Which function measures which observable.
#include "studies/observables.h"

namespace studies {

double measure(scenes::Observable observable, const Trial& trial) {
    using Function = double (*)(const Trial&);
    // In the order of the enumeration.
    static constexpr Function kFunctions[] = {
        pairLaw,         momentumDrift, energyRise,       positionError, heightError, frontError, radiusError,
        statisticsError, reboundError,  restitutionError, largestSpeed,  medianSpeed, fragments,  spacing,
        passed,          refusals,      stepBound,        order,         cost};
    return kFunctions[static_cast<std::size_t>(observable)](trial);
}

}  // namespace studies
