// The benchmark's loop of fused multiply-adds, which measures the machine's peak of floating-point operations. Compiled
// once for each instruction set. See multiplyAdd() in bench.h.
#include "studies/bench/bench.h"

#include <numeric>
#include <vector>

#include "engine/core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "studies/bench/machine_loops.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace studies {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Ten independent chains of multiply-adds, because each takes four or five cycles and two can start in every cycle.
double multiplyAddHere(std::size_t rounds, float& sink) {
    const hn::ScalableTag<float> tag;
    const auto factor = hn::Set(tag, 0.999F);
    const auto term = hn::Set(tag, 0.001F);
    auto a = hn::Iota(tag, 1.0F), b = a, c = a, d = a, e = a, f = a, g = a, h = a, i = a, j = a;
    for (std::size_t k = 0; k < rounds; ++k) {
        a = hn::MulAdd(a, factor, term);
        b = hn::MulAdd(b, factor, term);
        c = hn::MulAdd(c, factor, term);
        d = hn::MulAdd(d, factor, term);
        e = hn::MulAdd(e, factor, term);
        f = hn::MulAdd(f, factor, term);
        g = hn::MulAdd(g, factor, term);
        h = hn::MulAdd(h, factor, term);
        i = hn::MulAdd(i, factor, term);
        j = hn::MulAdd(j, factor, term);
    }
    const auto sum =
        hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(hn::Add(e, f), hn::Add(hn::Add(g, h), hn::Add(i, j))));
    sink = hn::GetLane(hn::SumOfLanes(tag, sum));
    return 20.0 * static_cast<double>(rounds * hn::Lanes(tag));
}

}  // namespace HWY_NAMESPACE
}  // namespace studies
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace studies {

HWY_EXPORT(multiplyAddHere);

double multiplyAdd(std::size_t threads, std::size_t rounds, float& sink) {
    std::vector<double> counts(threads);
    std::vector<float> sinks(threads);
    engine::inParallel(threads, 1,
                       [&](std::size_t t) { counts[t] = HWY_DYNAMIC_DISPATCH(multiplyAddHere)(rounds, sinks[t]); });
    sink = std::accumulate(sinks.begin(), sinks.end(), 0.0F);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
}

}  // namespace studies

#endif
