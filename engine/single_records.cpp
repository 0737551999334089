// Compiled once per instruction set: a particle's coordinates are three of four lanes. Where vectors have fewer, they
// are taken one by one.
#include "engine/single_records.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/single_records.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32
/// singleRecord() over lanes.
class RecordMaker {
    static constexpr hn::CappedTag<double, 4> kTag{};
    static constexpr hn::RebindToUnsigned<decltype(kTag)> kBits{};
    static constexpr hn::Rebind<std::uint32_t, decltype(kTag)> kWhole{};
    static constexpr hn::Rebind<float, decltype(kTag)> kFloat{};
    using V = hn::Vec<decltype(kTag)>;

 public:
    explicit RecordMaker(double perMetre) : perMetre_(hn::Set(kTag, perMetre)) {}

    HWY_INLINE void write(const Vec3& position, const Vec3& velocity, std::uint32_t id,
                          SinglePrecisionRecord& record) const {
        // The fourth lanes are written over.
        hn::StoreU(wrappedUnits(position), kWhole, reinterpret_cast<std::uint32_t*>(&record.x));
        record.id = id;
        hn::StoreU(hn::DemoteTo(kFloat, three(velocity)), kFloat, &record.vx);
        record.rest = restOf(position.x(), position.y(), position.z());
    }

 private:
    static V three(const Vec3& vector) { return hn::MaskedLoad(hn::FirstN(kTag, 3), kTag, vector.data()); }

    hn::Vec<decltype(kWhole)> wrappedUnits(const Vec3& position) const {
        const V units = hn::Mul(three(position), perMetre_);
        const V rounding = hn::Set(kTag, kWholeRounding);
        const V turns = hn::Sub(hn::Add(hn::Mul(units, hn::Set(kTag, 1.0 / kWordTurn)), rounding), rounding);
        const V rest = hn::Sub(units, hn::Mul(turns, hn::Set(kTag, kWordTurn)));
        return hn::TruncateTo(kWhole, hn::BitCast(kBits, hn::Add(rest, rounding)));
    }

    V perMetre_;
};
#else
class RecordMaker {
 public:
    explicit RecordMaker(double perMetre) : perMetre_(perMetre) {}

    void write(const Vec3& position, const Vec3& velocity, std::uint32_t id, SinglePrecisionRecord& record) const {
        record = singleRecord(position, velocity, id, perMetre_);
    }

 private:
    double perMetre_;
};
#endif

void makeSinglesHere(const OrderedParticles& of, double perMetre, const CellRange& places, SinglePrecisionRecord* all) {
    const RecordMaker maker(perMetre);
    const OrderedParticles from = of;  // nothing that is written is part of it
    for (std::size_t place = places.begin; place < places.end; ++place) {
        from.fetchAhead(place);
        const std::size_t p = from.order[place];
        maker.write(from.position[p], from.velocity[p], from.id[p], all[place]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(makeSinglesHere);

void makeSingles(const OrderedParticles& from, double perMetre, const CellRange& places, SinglePrecisionRecord* all) {
    HWY_DYNAMIC_DISPATCH(makeSinglesHere)(from, perMetre, places, all);
}

}  // namespace engine

#endif
