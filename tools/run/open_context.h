// The drawing context of a run, on as many threads as the run has.
#pragma once

#include <cstdlib>
#include <string>

#include "render/opengl/context.h"

namespace tools {

/// Throws render::SystemError.
inline render::Context openContext(render::Backend backend, int threads) {
    // llvmpipe reads its share of the machine from here; a user's own setting wins.
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
    return render::Context(backend);
}

}  // namespace tools
