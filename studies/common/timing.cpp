// One clock, one median.
#include "studies/common/timing.h"

#include <algorithm>
#include <chrono>

namespace studies {

double secondsOf(const Work& work, std::uint64_t repeats) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    for (std::uint64_t k = 0; k < repeats; ++k) work();
    return std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(repeats);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace studies
