// The number of threads of a run, applied to everything that starts threads: oneTBB and Mesa's software renderer.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdlib>
#include <string>

namespace tools {

/// Runs the work on exactly this many threads, even on a machine with fewer cores.
template <class Work>
void onThreads(int threads, const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(work);
}

/// Tells Mesa how many threads its software renderer, llvmpipe, is to use, and not to print warnings of devices that it
/// cannot open: where no other device can be used, the error says so. Values that the user has set in the environment
/// stay. Must be called before a context is created.
inline void prepareMesa(int threads) {
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);
}

}  // namespace tools
