// A plain loop that shows what the machine could do at most, to hold the kernels against.
#pragma once

#include <cstddef>

namespace studies {

/// Multiplies and adds in registers, in as many lanes as the vectors of this machine have, on as many threads.
/// Returns the number of floating-point operations done; `sink` takes a result, so that none is left out.
double multiplyAdd(std::size_t threads, std::size_t rounds, float& sink);

}  // namespace studies
