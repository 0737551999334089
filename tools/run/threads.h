// The number of threads of a run, applied to everything that starts threads: oneTBB and Mesa's rasterizer.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdlib>
#include <string>

#include "render/opengl/context.h"

namespace tools {

/// Runs the work on exactly this many threads, even on a machine with fewer cores.
template <class Work>
void onThreads(int threads, const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(work);
}

/// Tells llvmpipe, Mesa's software rasterizer, how many threads to use. A value that the user has set in the
/// environment stays. Must be called before a context is created.
inline void setRasterizerThreads(int threads) {
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

/// The OpenGL context of a run.
/// @throws render::SystemError
inline render::Context openContext(render::Backend backend, int threads) {
    setRasterizerThreads(threads);
    return render::Context(backend);
}

}  // namespace tools
