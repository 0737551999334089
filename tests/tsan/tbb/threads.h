// oneTBB's calls on plain threads, for ThreadSanitizer. Debian's oneTBB is not compiled with ThreadSanitizer, which
// therefore does not see how its threads pass work to each other: it reports races that are none, and misses some that
// are. The headers in this folder have the names of oneTBB's and as much of its interface as globular uses; the preset
// "tsan" puts the folder before the system's. What oneTBB may run concurrently runs concurrently here.
//
// ThreadSanitizer reports no race with an access whose call stack it has forgotten; hence the preset's history_size=7,
// its longest memory. It also takes a thread for another that has ended once there were more than 255 threads; hence
// threads are kept and used again.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb::on_threads {

/// The number of threads that loops of the current thread are divided among; a task_arena sets it.
inline thread_local int concurrency = static_cast<int>(std::thread::hardware_concurrency());

/// A thread that does one job after another for the thread that made it.
class Worker {
 public:
    Worker() : thread_([this] { doJobs(); }) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        start({});
        thread_.join();
    }

    /// An empty job ends the thread.
    void start(std::function<void()> job) {
        const std::lock_guard lock(mutex_);
        job_ = std::move(job);
        isBusy_ = true;
        changed_.notify_all();
    }

    void wait() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !isBusy_; });
    }

 private:
    void doJobs() {
        for (;;) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return isBusy_; });
            const std::function<void()> job = std::move(job_);
            lock.unlock();
            if (!job) return;
            job();
            lock.lock();
            isBusy_ = false;
            changed_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> job_;
    bool isBusy_ = false;
    std::thread thread_;
};

/// The workers of the current thread that have no job. Threads do not share workers: that would order what these
/// threads do one after the other, and ThreadSanitizer would miss races between them.
inline thread_local std::vector<std::unique_ptr<Worker>> idleWorkers;

inline std::unique_ptr<Worker> takeWorker() {
    if (idleWorkers.empty()) return std::make_unique<Worker>();
    std::unique_ptr<Worker> worker = std::move(idleWorkers.back());
    idleWorkers.pop_back();
    return worker;
}

/// Calls work(0) on this thread and work(1) ... work(count - 1) on one worker each, and waits for all. Nothing orders
/// the calls among each other. If some throw, throws the exception of the first in order of their numbers.
template <class Work>
void runAll(std::size_t count, const Work& work) {
    std::vector<std::exception_ptr> thrown(count);
    const auto call = [&](std::size_t index) {
        try {
            work(index);
        } catch (...) {
            thrown[index] = std::current_exception();
        }
    };
    std::vector<std::unique_ptr<Worker>> workers;
    for (std::size_t index = 1; index < count; ++index) {
        workers.push_back(takeWorker());
        workers.back()->start([&call, index, inherited = concurrency] {
            concurrency = inherited;
            call(index);
        });
    }
    if (count > 0) call(0);
    for (std::unique_ptr<Worker>& worker : workers) {
        worker->wait();
        idleWorkers.push_back(std::move(worker));
    }
    for (const std::exception_ptr& exception : thrown)
        if (exception) std::rethrow_exception(exception);
}

}  // namespace tbb::on_threads
