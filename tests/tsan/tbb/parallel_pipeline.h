// oneTBB's pipeline of stages in order, each on a plain thread of its own; with one thread they take turns. See
// threads.h.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "tbb/threads.h"

namespace tbb {

enum class filter_mode { serial_in_order };

class flow_control {
 public:
    void stop() { stopped_ = true; }
    bool isStopped() const { return stopped_; }

 private:
    bool stopped_ = false;
};

namespace on_threads {

/// A stage takes and gives a pointer; the first takes none, and the last gives none.
using Stage = std::function<void*(flow_control&, void*)>;

/// Items on their way from one stage to another. Each item orders what was done before it was put with what is done
/// after it is taken, and nothing else does. A lock or a common counter of the items would order more: what the giver
/// did for later items, too, where these are there already, so that ThreadSanitizer would miss a race with that. Hence
/// a number for each slot, and a taker that sleeps and looks again.
/// @pre At most `capacity` items are on their way, and the giver is ordered after the taking of the item whose slot it
/// uses again.
class Channel {
 public:
    explicit Channel(std::size_t capacity) : slots_(capacity) {}

    void put(void* item) {
        Slot& slot = slots_[put_ % slots_.size()];
        slot.item = item;
        slot.number.store(++put_, std::memory_order_release);
    }

    void* take() {
        Slot& slot = slots_[taken_++ % slots_.size()];
        while (slot.number.load(std::memory_order_acquire) != taken_)
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        return slot.item;
    }

 private:
    struct Slot {
        void* item = nullptr;
        std::atomic<std::size_t> number = 0;  ///< of the item, counted from 1
    };

    std::vector<Slot> slots_;
    std::size_t put_ = 0;    ///< the giver's own
    std::size_t taken_ = 0;  ///< the taker's own
};

inline void runInTurns(const std::vector<Stage>& stages) {
    flow_control flow;
    for (;;) {
        void* item = nullptr;
        for (const Stage& stage : stages) {
            item = stage(flow, item);
            if (flow.isStopped()) return;
        }
    }
}

/// The stages, a thread each. Items go from one to the next and from the last, as a token that the first may start
/// another, back to it.
class Pipeline {
 public:
    Pipeline(std::size_t tokens, const std::vector<Stage>& stages) : stages_(stages) {
        for (std::size_t k = 0; k < stages.size(); ++k) channels_.push_back(std::make_unique<Channel>(tokens + 1));
        for (std::size_t k = 0; k < tokens; ++k) channels_.back()->put(nullptr);
    }

    void run() {
        runAll(stages_.size(), [&](std::size_t k) { k == 0 ? runFirst() : runLater(k); });
    }

 private:
    /// What follows the last item.
    void* end() { return this; }

    bool hasFailed() const { return hasFailed_.load(std::memory_order_relaxed); }

    void runFirst() {
        flow_control flow;
        std::exception_ptr thrown;
        while (!flow.isStopped() && !hasFailed()) {
            channels_.back()->take();
            try {
                void* item = stages_[0](flow, nullptr);
                if (!flow.isStopped()) channels_[0]->put(item);
            } catch (...) {
                thrown = std::current_exception();
                flow.stop();
            }
        }
        channels_[0]->put(end());
        if (thrown) std::rethrow_exception(thrown);
    }

    /// After a failure, its own or another stage's, it passes items on as they are, so that no stage waits in vain.
    void runLater(std::size_t k) {
        flow_control flow;
        std::exception_ptr thrown;
        void* item = nullptr;
        while (item != end()) {
            item = channels_[k - 1]->take();
            if (item != end() && !hasFailed()) {
                try {
                    item = stages_[k](flow, item);
                } catch (...) {
                    thrown = std::current_exception();
                    hasFailed_.store(true, std::memory_order_relaxed);
                }
            }
            channels_[k]->put(item);
        }
        if (thrown) std::rethrow_exception(thrown);
    }

    const std::vector<Stage>& stages_;
    std::vector<std::unique_ptr<Channel>> channels_;  ///< k: from stage k to the one after
    std::atomic<bool> hasFailed_ = false;
};

}  // namespace on_threads

template <class In, class Out>
struct filter {
    std::vector<on_threads::Stage> stages;
};

template <class In, class Out, class Body>
filter<In, Out> make_filter(filter_mode, const Body& body) {
    if constexpr (std::is_void_v<In>)
        return {{[body](flow_control& flow, void*) -> void* { return body(flow); }}};
    else if constexpr (std::is_void_v<Out>)
        return {{[body](flow_control&, void* item) -> void* {
            body(static_cast<In>(item));
            return nullptr;
        }}};
    else
        return {{[body](flow_control&, void* item) -> void* { return body(static_cast<In>(item)); }}};
}

template <class In, class Between, class Out>
filter<In, Out> operator&(const filter<In, Between>& before, const filter<Between, Out>& after) {
    filter<In, Out> both{before.stages};
    both.stages.insert(both.stages.end(), after.stages.begin(), after.stages.end());
    return both;
}

inline void parallel_pipeline(std::size_t tokens, const filter<void, void>& chain) {
    if (on_threads::concurrency > 1)
        on_threads::Pipeline(tokens, chain.stages).run();
    else
        on_threads::runInTurns(chain.stages);
}

}  // namespace tbb
