// oneTBB's calls side by side, on plain threads. See threads.h.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "tbb/threads.h"

namespace tbb {

template <class... Works>
void parallel_invoke(const Works&... works) {
    const std::array<std::function<void()>, sizeof...(works)> calls = {std::cref(works)...};
    if (on_threads::concurrency > 1)
        on_threads::runAll(calls.size(), [&](std::size_t index) { calls[index](); });
    else
        for (const auto& call : calls) call();
}

}  // namespace tbb
