// Measures wall-clock times and takes medians. Used by the benchmark and by all studies that measure time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

namespace studies {

using Work = std::function<void()>;

/// Mean wall-clock time of a call of the work, s.
/// @param callCount  number of calls, at least 1
inline double secondsOf(const Work& work, std::uint64_t callCount = 1) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    for (std::uint64_t call = 0; call < callCount; ++call) work();
    return std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(callCount);
}

/// The median of the values; of an even number of values, the upper one of the middle two.
/// @pre values is not empty.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace studies
