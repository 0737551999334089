// Compiled once per instruction set. In float a particle's coordinates are three of four lanes; where vectors have
// fewer, they are taken one by one.
#include "engine/make_records.h"

#include <bit>
#include <cstddef>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/make_records.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <Readers readers, class D>
HWY_INLINE void put(hn::Vec<D> numbers, D d, hn::TFromD<D>* to) {
    if constexpr (readers == Readers::all)
        hn::Stream(numbers, d, to);
    else
        hn::Store(numbers, d, to);
}

#if HWY_TARGET == HWY_SCALAR
template <Readers readers>
void writeDouble(const OrderedParticles& from, std::size_t p, PairRecord& record) {
    record = doubleRecord(from, p);
}
#else
constexpr hn::FixedTag<double, 2> kTwo;

HWY_INLINE hn::Vec<decltype(kTwo)> two(double first, double second) {
    return hn::InterleaveLower(kTwo, hn::Set(kTwo, first), hn::Set(kTwo, second));
}

/// doubleRecord() two numbers at a time.
template <Readers readers>
HWY_INLINE void writeDouble(const OrderedParticles& from, std::size_t p, PairRecord& record) {
    static_assert(offsetof(PairRecord, radius) == 6 * sizeof(double) && sizeof(PairRecord) == 8 * sizeof(double));
    static_assert(std::endian::native == std::endian::little && offsetof(PairRecord, id) == 60);
    constexpr hn::RebindToUnsigned<decltype(kTwo)> kBits;
    const double* const x = from.position[p].data();
    const double* const v = from.velocity[p].data();
    const std::uint64_t names = from.material[p] | std::uint64_t{from.id[p]} << 32U;
    double* const to = &record.x;
    put<readers>(hn::LoadU(kTwo, x), kTwo, to);
    put<readers>(two(x[2], v[0]), kTwo, to + 2);
    put<readers>(hn::LoadU(kTwo, v + 1), kTwo, to + 4);
    const auto last =
        hn::InterleaveLower(kTwo, hn::Set(kTwo, from.radius[p]), hn::BitCast(kTwo, hn::Set(kBits, names)));
    put<readers>(last, kTwo, to + 6);
}
#endif

#if HWY_MAX_BYTES >= 32
/// singleRecord() over lanes.
class SingleWriter {
    static_assert(offsetof(SinglePrecisionRecord, id) == 12 && offsetof(SinglePrecisionRecord, rest) == 28);
    static constexpr hn::CappedTag<double, 4> kTag{};
    static constexpr hn::RebindToUnsigned<decltype(kTag)> kBits{};
    static constexpr hn::Rebind<std::uint32_t, decltype(kTag)> kWhole{};
    static constexpr hn::Rebind<float, decltype(kTag)> kFloat{};
    using V = hn::Vec<decltype(kTag)>;

 public:
    explicit SingleWriter(double perMetre) : perMetre_(hn::Set(kTag, perMetre)) {}

    template <Readers readers>
    HWY_INLINE void write(const OrderedParticles& from, std::size_t p, SinglePrecisionRecord& record) const {
        const Vec3& position = from.position[p];
        const auto velocity = hn::BitCast(kWhole, hn::DemoteTo(kFloat, three(from.velocity[p])));
        auto* const to = reinterpret_cast<std::uint32_t*>(&record);
        put<readers>(hn::InsertLane(wrappedUnits(position), 3, from.id[p]), kWhole, to);
        const std::uint32_t rest = restOf(position.x(), position.y(), position.z());
        put<readers>(hn::InsertLane(velocity, 3, rest), kWhole, to + 4);
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
class SingleWriter {
 public:
    explicit SingleWriter(double perMetre) : perMetre_(perMetre) {}

    template <Readers readers>
    void write(const OrderedParticles& from, std::size_t p, SinglePrecisionRecord& record) const {
        record = singleRecord(from.position[p], from.velocity[p], from.id[p], perMetre_);
    }

 private:
    double perMetre_;
};
#endif

template <class Record, class Write>
void writeAll(const OrderedParticles& of, const CellRange& places, Record* all, const Write& writeOne) {
    const OrderedParticles from = of;  // nothing that is written is part of it
    for (std::size_t place = places.begin; place < places.end; ++place) {
        from.fetchAhead<Record>(place);
        writeOne(from, from.order[place], all[place]);
    }
}

/// Calls body with the readers as a constant. What it wrote is on its way before anything that is written later, such
/// as what tells other threads to go on.
template <class Body>
void forReaders(Readers readers, const Body& body) {
    if (readers == Readers::writer) return body(std::integral_constant<Readers, Readers::writer>());
    body(std::integral_constant<Readers, Readers::all>());
    hwy::FlushStream();
}

void makeDoublesHere(const OrderedParticles& from, const CellRange& places, Readers readers, PairRecord* all) {
    forReaders(readers, [&](auto whose) {
        writeAll(from, places, all, [](const OrderedParticles& of, std::size_t p, PairRecord& record) {
            writeDouble<decltype(whose)::value>(of, p, record);
        });
    });
}

void makeSinglesHere(const OrderedParticles& from, double perMetre, const CellRange& places, Readers readers,
                     SinglePrecisionRecord* all) {
    const SingleWriter writer(perMetre);
    forReaders(readers, [&](auto whose) {
        writeAll(from, places, all, [&](const OrderedParticles& of, std::size_t p, SinglePrecisionRecord& record) {
            writer.template write<decltype(whose)::value>(of, p, record);
        });
    });
}

void makeCandidatesHere(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& order,
                        const CellRange& places, [[maybe_unused]] Readers readers, Candidates& all) {
    const Vec3* const position = positions.data();
    const std::uint32_t* const particle = order.data();
    double* const x = all.x.data();
    double* const y = all.y.data();
    double* const z = all.z.data();
    const auto makeOne = [&](std::size_t place) {
        const Vec3& of = position[particle[place]];
        x[place] = of.x();
        y[place] = of.y();
        z[place] = of.z();
    };
    std::size_t place = places.begin;
#if HWY_TARGET != HWY_SCALAR
    static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 2 * sizeof(double));
    if (readers == Readers::all) {
        for (; place < places.end && place % 2 != 0; ++place) makeOne(place);
        for (; place + 2 <= places.end; place += 2) {
            const Vec3& a = position[particle[place]];
            const Vec3& b = position[particle[place + 1]];
            hn::Stream(two(a.x(), b.x()), kTwo, x + place);
            hn::Stream(two(a.y(), b.y()), kTwo, y + place);
            hn::Stream(two(a.z(), b.z()), kTwo, z + place);
        }
        hwy::FlushStream();
    }
#endif
    for (; place < places.end; ++place) makeOne(place);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(makeDoublesHere);
HWY_EXPORT(makeSinglesHere);
HWY_EXPORT(makeCandidatesHere);

void makeDoubles(const OrderedParticles& from, const CellRange& places, Readers readers, PairRecord* all) {
    HWY_DYNAMIC_DISPATCH(makeDoublesHere)(from, places, readers, all);
}

void makeSingles(const OrderedParticles& from, double perMetre, const CellRange& places, Readers readers,
                 SinglePrecisionRecord* all) {
    HWY_DYNAMIC_DISPATCH(makeSinglesHere)(from, perMetre, places, readers, all);
}

void makeCandidates(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& order,
                    const CellRange& places, Readers readers, Candidates& all) {
    HWY_DYNAMIC_DISPATCH(makeCandidatesHere)(positions, order, places, readers, all);
}

}  // namespace engine

#endif
