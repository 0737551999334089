// The processes that compute one run together, each with a part of the particles (ranks, in the words of MPI). The
// engine does not know how they communicate: this interface is implemented for MPI by mpi/, and by threads in tests. A
// run in one process is alone, and all functions then return what they are given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bounding_box.h"

namespace engine {

/// Bytes to send to another rank, or room for those that it sends.
template <class Byte>
struct Message {
    int rank = 0;
    std::span<Byte> bytes;
};

/// All functions are collective: every rank calls the same ones in the same order. Results do not depend on the order
/// in which the ranks' contributions arrive.
class Ranks {
 public:
    virtual ~Ranks() = default;

    virtual int count() const { return 1; }
    virtual int own() const { return 0; }
    bool areMany() const { return count() > 1; }

    /// Replaces each number by its sum over the ranks, modulo 2^64.
    virtual void sum(std::span<std::int64_t> /*numbers*/) const {}

    /// Replaces each number by the largest over the ranks. No number may be NaN.
    virtual void maximize(std::span<double> /*numbers*/) const {}

    /// Sends one number to each rank, and returns the number that each rank sends to this one.
    virtual std::vector<std::int64_t> swapNumbers(const std::vector<std::int64_t>& numbers) const { return numbers; }

    /// Returns the numbers of all ranks, those of rank 0 first. The ranks may give different amounts of numbers.
    virtual std::vector<double> gatherAll(const std::vector<double>& numbers) const { return numbers; }

    /// Sends messages to other ranks and receives theirs, of sizes that both sides know. At most one message each way
    /// is for the same rank.
    virtual void swap(const std::vector<Message<const std::byte>>& /*toSend*/,
                      const std::vector<Message<std::byte>>& /*toReceive*/) const {}

    /// The rank that a particle at this position (m) is to be moved to, or emitted on. Not collective: all ranks give
    /// the same answer.
    virtual int ownerOf(const Vec3& /*position*/) const { return 0; }

    /// A run in one process.
    static const Ranks& alone();
};

/// Whether something holds on all ranks.
bool holdsOnAll(const Ranks& ranks, bool holds);

/// The largest number of any rank; not for NaN.
double largestOfAll(const Ranks& ranks, double number);

/// The smallest box that contains the boxes of all ranks, without bounds on a side where a box has a NaN.
BoundingBox overRanks(const Ranks& ranks, BoundingBox box);

/// The sum over the ranks.
std::uint64_t sumOfAll(const Ranks& ranks, std::uint64_t number);

}  // namespace engine
