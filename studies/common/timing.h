// Wall-clock times of work that is repeated. Used by the benchmarks and by the study of scaling.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace studies {

using Work = std::function<void()>;

/// Mean wall-clock seconds of a call, over so many.
double secondsOf(const Work& work, std::uint64_t repeats);

/// The middle value, the upper one of two. Shape: not empty.
double median(std::vector<double> values);

}  // namespace studies
