// oneTBB's limit of all threads, which the arenas' numbers of threads make unnecessary here. See threads.h.
#pragma once

#include <cstddef>

namespace tbb {

class global_control {
 public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t) {}
    global_control(const global_control&) = delete;
    global_control& operator=(const global_control&) = delete;
    ~global_control() {}
};

}  // namespace tbb
