// Ranks that are threads of one process, so that everything but the transport is tested without MPI.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/ranks/ranks.h"

namespace thread_ranks {

using engine::Message;
using engine::Vec3;

/// Names the owner of each position.
using Owner = std::function<int(const Vec3& position)>;

/// A place where threads wait for each other. std::barrier of GCC 12 may wait for ever.
class Barrier {
 public:
    explicit Barrier(int count) : count_(count) {}

    void arriveAndWait() {
        std::unique_lock lock(mutex_);
        const int phase = phase_;
        if (++arrived_ == count_) {
            arrived_ = 0;
            ++phase_;
            changed_.notify_all();
        }
        changed_.wait(lock, [&] { return phase_ != phase; });
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int count_;
    int arrived_ = 0;
    int phase_ = 0;
};

/// What the ranks put down for the others to read between two barriers.
struct Table {
    explicit Table(int count)
        : barrier(count), integers(static_cast<std::size_t>(count)), doubles(integers.size()), sends(integers.size()) {}

    Barrier barrier;
    std::vector<std::vector<std::int64_t>> integers;
    std::vector<std::vector<double>> doubles;
    std::vector<std::vector<Message<const std::byte>>> sends;
};

class ThreadRanks : public engine::Ranks {
 public:
    ThreadRanks(Table& table, int own, Owner owner) : table_(table), own_(own), owner_(std::move(owner)) {}

    int count() const override { return static_cast<int>(table_.doubles.size()); }
    int own() const override { return own_; }
    int ownerOf(const Vec3& position) const override { return owner_(position); }

    void sum(std::span<std::int64_t> numbers) const override {
        put(table_.integers, {numbers.begin(), numbers.end()});
        std::ranges::fill(numbers, 0);
        for (const auto& others : table_.integers)
            for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] += others.at(k);
        table_.barrier.arriveAndWait();
    }

    void maximize(std::span<double> numbers) const override {
        put(table_.doubles, {numbers.begin(), numbers.end()});
        for (const auto& others : table_.doubles)
            for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = std::max(numbers[k], others.at(k));
        table_.barrier.arriveAndWait();
    }

    std::vector<std::int64_t> swapNumbers(const std::vector<std::int64_t>& numbers) const override {
        put(table_.integers, numbers);
        std::vector<std::int64_t> received;
        for (const auto& others : table_.integers) received.push_back(others.at(static_cast<std::size_t>(own_)));
        table_.barrier.arriveAndWait();
        return received;
    }

    std::vector<double> gatherAll(const std::vector<double>& numbers) const override {
        put(table_.doubles, numbers);
        std::vector<double> all;
        for (const auto& others : table_.doubles) all.insert(all.end(), others.begin(), others.end());
        table_.barrier.arriveAndWait();
        return all;
    }

    void swap(const std::vector<Message<const std::byte>>& toSend,
              const std::vector<Message<std::byte>>& toReceive) const override {
        put(table_.sends, toSend);
        for (const Message<std::byte>& room : toReceive) {
            const auto& sent = table_.sends.at(static_cast<std::size_t>(room.rank));
            const auto message = std::ranges::find(sent, own_, &Message<const std::byte>::rank);
            if (message == sent.end() || message->bytes.size() != room.bytes.size()) std::terminate();
            std::memcpy(room.bytes.data(), message->bytes.data(), room.bytes.size());
        }
        table_.barrier.arriveAndWait();
    }

 private:
    /// Puts down what this rank gives, and waits for the others to do so.
    template <class Items>
    void put(std::vector<Items>& on, Items items) const {
        on[static_cast<std::size_t>(own_)] = std::move(items);
        table_.barrier.arriveAndWait();
    }

    Table& table_;
    int own_;
    Owner owner_;
};

/// Calls body(ranks) on as many ranks, and waits for them. An exception must be thrown by all ranks; that of the last
/// one is thrown again.
inline void onRanks(int count, const Owner& owner, const std::function<void(const engine::Ranks&)>& body) {
    Table table(count);
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(count));
    std::vector<std::thread> threads;
    for (int rank = 0; rank < count; ++rank)
        threads.emplace_back([&, rank] {
            try {
                body(ThreadRanks(table, rank, owner));
            } catch (...) {
                thrown[static_cast<std::size_t>(rank)] = std::current_exception();
            }
        });
    for (std::thread& thread : threads) thread.join();
    if (thrown.back()) std::rethrow_exception(thrown.back());
}

/// Slabs along an axis, of equal width (m) and numbered from -infinity on, which wrap around after the last rank.
inline Owner slabs(int count, double width) {
    return [=](const Vec3& position) {
        const auto slab = static_cast<int>(std::floor(position.x() / width));
        return (slab % count + count) % count;
    };
}

/// Particles scattered over the ranks without any regard to where they are.
inline Owner scattered(int count) {
    return [=](const Vec3& position) {
        std::uint64_t bits = 0;
        for (int axis = 0; axis < 3; ++axis) bits = 31 * bits + std::bit_cast<std::uint64_t>(position[axis]);
        return static_cast<int>((bits * std::uint64_t{0x9E3779B97F4A7C15} >> 40) % static_cast<std::uint64_t>(count));
    };
}

}  // namespace thread_ranks
