// oneTBB's arenas on plain threads: an arena is no more than a number of threads. See threads.h.
#pragma once

#include "tbb/threads.h"

namespace tbb {

class task_arena {
 public:
    explicit task_arena(int concurrency) : concurrency_(concurrency) {}

    template <class Work>
    void execute(const Work& work) {
        struct Restore {
            int before = on_threads::concurrency;
            ~Restore() { on_threads::concurrency = before; }
        } const restore;
        on_threads::concurrency = concurrency_;
        work();
    }

 private:
    int concurrency_;
};

namespace this_task_arena {

inline int max_concurrency() {
    return on_threads::concurrency;
}

/// Threads that wait here take up no other work anyway.
template <class Work>
void isolate(const Work& work) {
    work();
}

}  // namespace this_task_arena
}  // namespace tbb
