// Which function measures which observable.
#include "studies/stability/observables.h"

#include <fmt/format.h>

#include "scenes/text/input_error.h"

namespace studies {

namespace {

/// Whether there is something to measure where nobody is left at the end.
bool needsNobody(scenes::Observable observable) {
    return observable == scenes::Observable::pairLaw || observable == scenes::Observable::refusals;
}

}  // namespace

double measure(scenes::Observable observable, const ObservableInput& trial) {
    if (trial.run.frames.back().count() == 0 && !needsNobody(observable))
        throw scenes::InputError({{trial.scene.sourceName, 0, 0,
                                   fmt::format("no particle is there at the end of the run, so there is no {}",
                                               scenes::infoOf(observable).name)}});
    using Function = double (*)(const ObservableInput&);
    // In the order of the enumeration.
    static constexpr Function kFunctions[] = {
        pairLaw,         momentumDrift, energyRise,       positionError, heightError, frontError, radiusError,
        statisticsError, reboundError,  restitutionError, largestSpeed,  medianSpeed, fragments,  spacing,
        tunnelingCount,  refusals,      stepBound,        order,         cost};
    return kFunctions[static_cast<std::size_t>(observable)](trial);
}

}  // namespace studies
