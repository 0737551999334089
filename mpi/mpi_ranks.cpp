// Calls MPI. Its errors end the run: they mean that a process or the network is gone.
#include "mpi/mpi_ranks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace mpi {
namespace {

/// MPI counts in int; longer messages are sent in parts.
constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

int intOf(std::size_t count) {
    if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::length_error("too much for one message of MPI");
    return static_cast<int>(count);
}

}  // namespace

MpiRanks::MpiRanks(MPI_Comm communicator) : communicator_(communicator), partition_(communicator) {
    MPI_Comm_size(communicator, &count_);
    MPI_Comm_rank(communicator, &own_);
}

void MpiRanks::sum(std::span<std::int64_t> numbers) const {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), intOf(numbers.size()), MPI_INT64_T, MPI_SUM, communicator_);
}

void MpiRanks::maximize(std::span<double> numbers) const {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), intOf(numbers.size()), MPI_DOUBLE, MPI_MAX, communicator_);
}

std::vector<std::int64_t> MpiRanks::swapNumbers(const std::vector<std::int64_t>& numbers) const {
    std::vector<std::int64_t> received(numbers.size());
    MPI_Alltoall(numbers.data(), 1, MPI_INT64_T, received.data(), 1, MPI_INT64_T, communicator_);
    return received;
}

std::vector<double> MpiRanks::gatherAll(const std::vector<double>& numbers) const {
    const int own = intOf(numbers.size());
    std::vector<int> counts(static_cast<std::size_t>(count_));
    MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator_);
    std::vector<int> starts;
    std::size_t total = 0;
    for (const int count : counts) {
        starts.push_back(intOf(total));
        total += static_cast<std::size_t>(count);
    }
    std::vector<double> all(total);
    MPI_Allgatherv(numbers.data(), own, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                   communicator_);
    return all;
}

void MpiRanks::swap(const std::vector<engine::Message<const std::byte>>& toSend,
                    const std::vector<engine::Message<std::byte>>& toReceive) const {
    std::vector<MPI_Request> requests;
    const auto inParts = [&](const auto& message, const auto& start) {
        for (std::size_t begin = 0; begin < message.bytes.size(); begin += kLongestMessage) {
            const auto part = message.bytes.subspan(begin, std::min(kLongestMessage, message.bytes.size() - begin));
            start(part.data(), intOf(part.size()), message.rank, &requests.emplace_back());
        }
    };
    for (const auto& message : toReceive)
        inParts(message, [&](std::byte* to, int size, int rank, MPI_Request* request) {
            MPI_Irecv(to, size, MPI_BYTE, rank, 0, communicator_, request);
        });
    for (const auto& message : toSend)
        inParts(message, [&](const std::byte* from, int size, int rank, MPI_Request* request) {
            MPI_Isend(from, size, MPI_BYTE, rank, 0, communicator_, request);
        });
    MPI_Waitall(intOf(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

std::string MpiRanks::broadcast(std::string text) const {
    int size = intOf(text.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, communicator_);
    text.resize(static_cast<std::size_t>(size));
    MPI_Bcast(text.data(), size, MPI_CHAR, 0, communicator_);
    return text;
}

}  // namespace mpi
