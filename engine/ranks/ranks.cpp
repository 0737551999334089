// A run in one process, and reductions of single values.
#include "engine/ranks/ranks.h"

namespace engine {

const Ranks& Ranks::alone() {
    static const Ranks ranks;
    return ranks;
}

bool holdsOnAll(const Ranks& ranks, bool holds) {
    return largestOfAll(ranks, holds ? 0.0 : 1.0) == 0.0;
}

double largestOfAll(const Ranks& ranks, double number) {
    ranks.maximize({&number, 1});
    return number;
}

std::uint64_t sumOfAll(const Ranks& ranks, std::uint64_t number) {
    auto sum = static_cast<std::int64_t>(number);
    ranks.sum({&sum, 1});
    return static_cast<std::uint64_t>(sum);
}

}  // namespace engine
