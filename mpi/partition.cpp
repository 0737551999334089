// Calls Zoltan's recursive coordinate bisection.
#include "mpi/partition.h"

#include <zoltan.h>

#include <array>
#include <stdexcept>

namespace mpi {
namespace {

using Positions = std::vector<engine::Vec3>;

// What Zoltan asks about the particles, whose positions `data` points to.

int countOf(void* data, int* error) {
    *error = ZOLTAN_OK;
    return static_cast<int>(static_cast<const Positions*>(data)->size());
}

void list(void* data, int /*globalIdSize*/, int /*localIdSize*/, ZOLTAN_ID_PTR /*globalIds*/, ZOLTAN_ID_PTR localIds,
          int /*weights*/, float* /*weightOf*/, int* error) {
    *error = ZOLTAN_OK;
    const auto count = static_cast<ZOLTAN_ID_TYPE>(static_cast<const Positions*>(data)->size());
    for (ZOLTAN_ID_TYPE p = 0; p < count; ++p) localIds[p] = p;
}

int dimensions(void* /*data*/, int* error) {
    *error = ZOLTAN_OK;
    return 3;
}

void places(void* data, int /*globalIdSize*/, int /*localIdSize*/, int count, ZOLTAN_ID_PTR /*globalIds*/,
            ZOLTAN_ID_PTR localIds, int /*dimensions*/, double* coordinates, int* error) {
    *error = ZOLTAN_OK;
    const auto& positions = *static_cast<const Positions*>(data);
    for (int k = 0; k < count; ++k)
        for (int axis = 0; axis < 3; ++axis) coordinates[3 * k + axis] = positions[localIds[k]][axis];
}

void require(int code, const char* what) {
    if (code == ZOLTAN_FATAL || code == ZOLTAN_MEMERR) throw std::runtime_error(std::string("Zoltan cannot ") + what);
}

/// The lists of particles to move that Zoltan returns. They are not used: ownerOf() asks for the cuts instead.
struct Moves {
    int count = 0;
    ZOLTAN_ID_PTR globalIds = nullptr;
    ZOLTAN_ID_PTR localIds = nullptr;
    int* ranks = nullptr;
    int* parts = nullptr;

    Moves() = default;
    Moves(const Moves&) = delete;
    Moves& operator=(const Moves&) = delete;
    ~Moves() { Zoltan_LB_Free_Part(&globalIds, &localIds, &ranks, &parts); }
};

}  // namespace

void Partition::Destroy::operator()(Zoltan_Struct* zoltan) const {
    Zoltan_Destroy(&zoltan);
}

Partition::Partition(MPI_Comm communicator) {
    float version = 0.0F;
    require(Zoltan_Initialize(0, nullptr, &version), "start");
    zoltan_.reset(Zoltan_Create(communicator));
    if (!zoltan_) throw std::runtime_error("Zoltan cannot start");
    constexpr std::array<std::array<const char*, 2>, 6> kSettings = {
        {{"DEBUG_LEVEL", "0"},  // first, or the others are printed
         {"LB_METHOD", "RCB"},
         {"KEEP_CUTS", "1"},
         {"NUM_GID_ENTRIES", "1"},
         {"NUM_LID_ENTRIES", "1"},
         {"IMBALANCE_TOL", "1.02"}}};
    for (const auto& [name, value] : kSettings) require(Zoltan_Set_Param(zoltan_.get(), name, value), "be set up");
}

void Partition::divide(const std::vector<engine::Vec3>& positions) {
    void* const data = const_cast<std::vector<engine::Vec3>*>(&positions);  // which the functions above only read
    Zoltan_Set_Num_Obj_Fn(zoltan_.get(), countOf, data);
    Zoltan_Set_Obj_List_Fn(zoltan_.get(), list, data);
    Zoltan_Set_Num_Geom_Fn(zoltan_.get(), dimensions, data);
    Zoltan_Set_Geom_Multi_Fn(zoltan_.get(), places, data);
    int isChanged = 0;
    int globalIdSize = 0;
    int localIdSize = 0;
    Moves in;
    Moves out;
    require(Zoltan_LB_Partition(zoltan_.get(), &isChanged, &globalIdSize, &localIdSize, &in.count, &in.globalIds,
                                &in.localIds, &in.ranks, &in.parts, &out.count, &out.globalIds, &out.localIds,
                                &out.ranks, &out.parts),
            "divide the particles");
    isDivided_ = true;
}

int Partition::ownerOf(const engine::Vec3& position) const {
    if (!isDivided_) return 0;
    std::array<double, 3> coordinates = {position.x(), position.y(), position.z()};
    int rank = 0;
    require(Zoltan_LB_Point_Assign(zoltan_.get(), coordinates.data(), &rank), "find the rank of a place");
    return rank;
}

}  // namespace mpi
