// oneTBB's group of tasks, each on a thread of its own. See threads.h.
#pragma once

#include <deque>
#include <exception>
#include <memory>
#include <utility>

#include "tbb/threads.h"

namespace tbb {

class task_group {
 public:
    task_group() = default;
    task_group(const task_group&) = delete;
    task_group& operator=(const task_group&) = delete;
    ~task_group() { finish(); }

    template <class Work>
    void run(const Work& work) {
        Task& task = tasks_.emplace_back();
        task.worker = on_threads::takeWorker();
        task.worker->start([&task, work, inherited = on_threads::concurrency] {
            on_threads::concurrency = inherited;
            try {
                work();
            } catch (...) {
                task.thrown = std::current_exception();
            }
        });
    }

    void wait() {
        finish();
        const std::deque<Task> done = std::exchange(tasks_, {});
        for (const Task& task : done)
            if (task.thrown) std::rethrow_exception(task.thrown);
    }

 private:
    struct Task {
        std::unique_ptr<on_threads::Worker> worker;
        std::exception_ptr thrown;
    };

    void finish() {
        for (Task& task : tasks_) {
            if (!task.worker) continue;
            task.worker->wait();
            on_threads::idleWorkers.push_back(std::move(task.worker));
        }
    }

    std::deque<Task> tasks_;  ///< a deque, because the tasks must stay where they are while more are added
};

}  // namespace tbb
