// Ranks that communicate by MPI.
#pragma once

#include <mpi.h>

#include <string>

#include "engine/ranks/ranks.h"
#include "mpi/partition.h"

namespace mpi {

class MpiRanks : public engine::Ranks {
 public:
    explicit MpiRanks(MPI_Comm communicator);

    int count() const override { return count_; }
    int own() const override { return own_; }
    void sum(std::span<std::int64_t> numbers) const override;
    void maximize(std::span<double> numbers) const override;
    std::vector<std::int64_t> swapNumbers(const std::vector<std::int64_t>& numbers) const override;
    std::vector<double> gatherAll(const std::vector<double>& numbers) const override;
    void swap(const std::vector<engine::Message<const std::byte>>& toSend,
              const std::vector<engine::Message<std::byte>>& toReceive) const override;
    int ownerOf(const engine::Vec3& position) const override { return partition_.ownerOf(position); }

    /// Divides space anew for particles at these positions (m), of which each rank gives some.
    void divide(const std::vector<engine::Vec3>& positions) { partition_.divide(positions); }

    /// Whether space has been divided; until then all of it belongs to rank 0.
    bool isDivided() const { return partition_.isDivided(); }

    /// Sends a text from rank 0 to all; returns it.
    std::string broadcast(std::string text) const;

 private:
    MPI_Comm communicator_;
    int count_ = 1;
    int own_ = 0;
    Partition partition_;
};

}  // namespace mpi
