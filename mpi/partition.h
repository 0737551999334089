// The division of space among ranks: boxes with about as many particles each, by recursive coordinate bisection. Zoltan
// finds them.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "engine/core/vec3.h"

struct Zoltan_Struct;

namespace mpi {

/// Names the rank that each place belongs to. Before the first division all belong to rank 0.
class Partition {
 public:
    explicit Partition(MPI_Comm communicator);

    /// Divides space so that all ranks have about as many of the particles. Collective.
    /// @param positions  of some of the particles, each of which is given by one rank, m
    void divide(const std::vector<engine::Vec3>& positions);

    /// Whether divide() has been called.
    bool isDivided() const { return isDivided_; }

    int ownerOf(const engine::Vec3& position) const;

 private:
    struct Destroy {
        void operator()(Zoltan_Struct* zoltan) const;
    };

    std::unique_ptr<Zoltan_Struct, Destroy> zoltan_;
    bool isDivided_ = false;
};

}  // namespace mpi
