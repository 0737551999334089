// Ray casting of metaballs with Highway, one ray per lane; this file is compiled once per instruction set.
//
// Along a ray at view depth t the root of a ball's kernel is p - d^2 q^2 = w - u^2 (p its peak, q its slope) with u =
// (t - t0) s, where t0 is the depth closest to the ball's center, s = |direction| q and w = p - (closest distance)^2
// q^2. Hence the field and its derivative:
//   F = sum max(0, w - u^2)^2,     F' = -4 sum max(0, w - u^2) u s.
// F is sampled on a grid of depths. A sample at or above the threshold brackets the surface; between two samples below
// it a sliver can hide only if F rises at the first and falls at the second, and then the maximum is looked for.
#include "render/cpu/metaballs/metaball_cast.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <tbb/cache_aligned_allocator.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/metaball_cast.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/metaballs/ball_culling-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// Newton steps on the cubic between two samples, then at most so many on the field, until one moved by less than this
// share of the distance between samples, which is half a radius: what such a step leaves is of the order of its square,
// 5e-5 radii, but at grazing rays, where it is half of it. More guesses gain nothing: each waits for the one before, as
// the field's steps do, which are exact.
constexpr int kGuesses = 2;
constexpr int kRefinements = 6;
constexpr float kSmallStep = 1e-2F;
constexpr int kPeakSearches = 4;  // steps toward the maximum of a suspected sliver

/// The balls that the rays of a group meet, in the order of the tile's list.
struct NearBalls {
    std::vector<float, tbb::cache_aligned_allocator<float>> lanes;  ///< per ball: w, t0 s and s, each one vector
    std::vector<float> nearDepth, farDepth;
    std::vector<std::uint32_t> index;
    std::size_t count = 0;

    /// Empty, with room for so many.
    void prepare(std::size_t most, std::size_t laneCount) {
        count = 0;
        if (index.size() > most) return;
        // A ball is written before it is known to be met, and whole vectors of depths are read.
        lanes.resize(3 * laneCount * (most + 1));
        nearDepth.resize(most + laneCount);
        farDepth.resize(most + laneCount);
        index.resize(most + 1);
    }
};

struct Value {
    V field;
    V slope;
};

/// A place on each ray.
struct Sample {
    V depth;
    Value value;
};

Sample select(M mask, const Sample& yes, const Sample& no) {
    return {
        hn::IfThenElse(mask, yes.depth, no.depth),
        {hn::IfThenElse(mask, yes.value.field, no.value.field), hn::IfThenElse(mask, yes.value.slope, no.value.slope)}};
}

struct Root {
    V root;  ///< w - u^2
    V turn;  ///< u s
};

/// One group of rays on its way through a tile.
class Group {
 public:
    /// at: where its rays cross the plane; open, from: as cast() has them.
    Group(const FieldCast& cast, TileBalls& balls, NearBalls& near, const ImagePoint& at, M open, V from)
        : cast_(cast),
          balls_(balls),
          near_(near),
          start_(balls.size() == 0 ? 0.0F : std::max(0.0F, balls.nearDepth(0))),
          begin_(sampleBefore(hn::GetLane(minOfLanes(from, open)))),
          sieve_(balls, Bundle(cast.frame, at, open), depthOf(begin_)) {
        const D d;
        near_.prepare(balls.size(), hn::Lanes(d));
        const bool perspective = cast.frame.perspective;
        const V one = hn::Set(d, 1.0F);
        const V zero = hn::Zero(d);
        directionX_ = perspective ? at.x : zero;
        directionY_ = perspective ? at.y : zero;
        originX_ = perspective ? zero : at.x;
        originY_ = perspective ? zero : at.y;
        const V square = hn::Add(hn::Add(hn::Mul(directionX_, directionX_), hn::Mul(directionY_, directionY_)), one);
        length_ = hn::Sqrt(square);
        inverseSquare_ = hn::Div(one, square);
    }

    /// Walks until every lane of `open` has met the surface, left the balls behind or come to its end; returns the
    /// depth, negative without a hit. from, to: view depths between which the surface is looked for.
    V cast(M open, V from, V to) {
        const D d;
        const V threshold = hn::Set(d, cast_.threshold);
        long k = begin_;
        float t = depthOf(k);
        admit(t);
        Sample here = sampleAt(hn::Set(d, t));
        M begun = hn::And(open, hn::Le(from, here.depth));
        most_ = hn::IfThenElseZero(begun, here.value.field);
        M found = hn::And(begun, hn::Ge(here.value.field, threshold));
        Sample low = here;
        Sample high = here;
        open = hn::AndNot(found, open);
        while (!hn::AllFalse(d, open)) {
            if (first_ == begun_) {
                if (!leap(k)) break;
                t = depthOf(k);
                here = {hn::Set(d, t), {hn::Zero(d), hn::Zero(d)}};
            }
            const float ahead = depthOf(++k);
            admit(ahead);
            const Sample there = sampleAt(hn::Set(d, ahead));
            begun = hn::And(open, hn::Le(from, here.depth));
            M met = hn::And(hn::And(open, hn::Le(from, there.depth)), hn::Ge(there.value.field, threshold));
            const M suspect = hn::AndNot(met, hn::And(begun, mayPeak(here.value, there.value, ahead - t)));
            Sample reached = there;
            if (!hn::AllFalse(d, suspect)) {
                const Sample peak = sampleAt(peakBetween(t, ahead));
                const M sliver = hn::And(suspect, hn::Ge(peak.value.field, threshold));
                reached = select(sliver, peak, reached);
                met = hn::Or(met, sliver);
            }
            most_ = hn::Max(most_, hn::IfThenElseZero(begun, there.value.field));
            // Without a branch, which would be mistaken too often.
            firstFound_ = hn::AllFalse(d, found) ? first_ : firstFound_;
            // A ray that begins between the samples begins within the surface.
            low = select(met, select(begun, here, there), low);
            high = select(met, reached, high);
            found = hn::Or(found, met);
            open = hn::AndNot(met, hn::And(open, hn::Le(there.depth, to)));
            t = ahead;
            here = there;
            pass(t);
        }
        return hn::IfThenElse(found, refine(low, high), hn::Set(d, -1.0F));
    }

    /// The greatest sample of the field that each ray of cast() met.
    V most() const { return most_; }

    /// Normal and color at the depths found. Lanes without a hit get something finite or not; nobody reads them.
    void look(V depth, std::size_t place, RayBlock& block) const {
        const D d;
        const V px = hn::Add(originX_, hn::Mul(depth, directionX_));
        const V py = hn::Add(originY_, hn::Mul(depth, directionY_));
        V n[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        V c[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        V open[6] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        V weight = hn::Zero(d);
        for (std::size_t b = firstFound_; b < begun_; ++b) {
            const FieldBall& ball = cast_.balls[near_.index[b]];
            const V k = hn::Max(rootOf(b, depth).root, hn::Zero(d));
            // Many of the balls on the way end before the hit or begin behind it.
            if (hn::AllTrue(d, hn::Le(k, hn::Zero(d)))) continue;
            const V pull = hn::Mul(k, hn::Set(d, ball.slope * ball.slope));
            n[0] = hn::Add(n[0], hn::Mul(pull, hn::Sub(px, hn::Set(d, ball.center.x))));
            n[1] = hn::Add(n[1], hn::Mul(pull, hn::Sub(py, hn::Set(d, ball.center.y))));
            n[2] = hn::Add(n[2], hn::Mul(pull, hn::Sub(depth, hn::Set(d, ball.center.z))));
            const V share = hn::Mul(k, k);
            weight = hn::Add(weight, share);
            const BallLook& own = cast_.looks[near_.index[b]];
            for (int channel = 0; channel < 3; ++channel)
                c[channel] = hn::Add(c[channel], hn::Mul(share, hn::Set(d, own.color[channel])));
            if (!cast_.skyVisibility) continue;
            for (std::size_t side = 0; side < 6; ++side)
                open[side] = hn::Add(open[side], hn::Mul(share, hn::Set(d, own.open[side])));
        }
        const V square = hn::Add(hn::Add(hn::Mul(n[0], n[0]), hn::Mul(n[1], n[1])), hn::Mul(n[2], n[2]));
        const V scale = hn::Div(hn::Set(d, 1.0F), hn::Sqrt(hn::Max(square, hn::Set(d, 1e-30F))));
        for (V& component : n) component = hn::Mul(component, scale);
        const V share = hn::Div(hn::Set(d, 1.0F), hn::Max(weight, hn::Set(d, 1e-30F)));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            hn::StoreU(n[axis], d, &block.normal[axis][place]);
            hn::StoreU(hn::Mul(c[axis], share), d, &block.color[axis][place]);
        }
        if (!cast_.skyVisibility) return;
        for (V& value : open) value = hn::Mul(value, share);
        lookAround(n, open, place, block);
    }

    /// Openness along the normal (unit, view coordinates), against it and along the mirrored ray; open: toward the six
    /// sides.
    void lookAround(const V* normal, const V* open, std::size_t place, RayBlock& block) const {
        const D d;
        // The ray d and its mirror image d - 2 (d.n) n, both of unit length.
        const V inverse = hn::Div(hn::Set(d, 1.0F), length_);
        const V ray[3] = {hn::Mul(directionX_, inverse), hn::Mul(directionY_, inverse), inverse};
        const V cosine =
            hn::Add(hn::Add(hn::Mul(ray[0], normal[0]), hn::Mul(ray[1], normal[1])), hn::Mul(ray[2], normal[2]));
        V mirrored[3];
        V against[3];
        for (int axis = 0; axis < 3; ++axis) {
            mirrored[axis] = hn::Sub(ray[axis], hn::Mul(hn::Mul(hn::Set(d, 2.0F), cosine), normal[axis]));
            against[axis] = hn::Neg(normal[axis]);
        }
        hn::StoreU(openAlong(normal, open), d, &block.open[0][place]);
        hn::StoreU(openAlong(against, open), d, &block.open[1][place]);
        hn::StoreU(openAlong(mirrored, open), d, &block.open[2][place]);
    }

 private:
    /// Sum over the world's axes of the squared component times the value on its side.
    V openAlong(const V* direction, const V* open) const {
        const D d;
        const CameraFrame& frame = cast_.frame;
        V sum = hn::Zero(d);
        for (int axis = 0; axis < 3; ++axis) {
            const V world = hn::Add(hn::Add(hn::Mul(direction[0], hn::Set(d, frame.right[axis])),
                                            hn::Mul(direction[1], hn::Set(d, frame.up[axis]))),
                                    hn::Mul(direction[2], hn::Set(d, frame.forward[axis])));
            const V value = hn::IfThenElse(hn::Gt(world, hn::Zero(d)), open[2 * axis], open[2 * axis + 1]);
            sum = hn::Add(sum, hn::Mul(hn::Mul(world, world), value));
        }
        return sum;
    }

    float depthOf(long k) const { return start_ + static_cast<float>(k) * cast_.step; }

    /// The last sample that does not lie beyond this depth; the first where all do.
    long sampleBefore(float depth) const { return std::max(0L, static_cast<long>((depth - start_) / cast_.step)); }

    /// Takes in the balls that begin before depth t and that some ray meets.
    void admit(float t) {
        while (sieved_ < balls_.size() && balls_.nearDepth(sieved_) <= t) takeIn();
        begun_ = firstBeyond(near_.nearDepth, begun_, near_.count, t);
    }

    /// Takes in the next vector of balls, as far as some ray meets them.
    void takeIn() {
        const D d;
        for (std::uint32_t left = sieve_.met(sieved_); left != 0; left &= left - 1)
            put(balls_.index(sieved_ + static_cast<std::size_t>(std::countr_zero(left))));
        sieved_ += hn::Lanes(d);
    }

    void put(std::uint32_t index) {
        const D d;
        const FieldBall& ball = cast_.balls[index];
        const V x = hn::Sub(hn::Set(d, ball.center.x), originX_);
        const V y = hn::Sub(hn::Set(d, ball.center.y), originY_);
        const V z = hn::Set(d, ball.center.z);
        const V along = hn::Add(hn::Add(hn::Mul(x, directionX_), hn::Mul(y, directionY_)), z);
        const V closest = hn::Mul(along, inverseSquare_);
        const V offX = hn::Sub(x, hn::Mul(closest, directionX_));
        const V offY = hn::Sub(y, hn::Mul(closest, directionY_));
        const V offZ = hn::Sub(z, closest);
        const V square = hn::Add(hn::Add(hn::Mul(offX, offX), hn::Mul(offY, offY)), hn::Mul(offZ, offZ));
        const V w = hn::Sub(hn::Set(d, ball.peak), hn::Mul(square, hn::Set(d, ball.slope * ball.slope)));
        const V s = hn::Mul(length_, hn::Set(d, ball.slope));
        float* lanes = &near_.lanes[3 * near_.count * hn::Lanes(d)];
        hn::Store(w, d, lanes);
        hn::Store(hn::Mul(closest, s), d, lanes + hn::Lanes(d));
        hn::Store(s, d, lanes + 2 * hn::Lanes(d));
        near_.nearDepth[near_.count] = ball.center.z - ball.reach;
        near_.farDepth[near_.count] = ball.center.z + ball.reach;
        near_.index[near_.count] = index;
        // Most are met; the others are written over.
        near_.count += hn::AllFalse(d, hn::Gt(w, hn::Zero(d))) ? 0U : 1U;
    }

    /// The first of these depths that is not less than t, a vector at a time.
    static std::size_t firstBeyond(const std::vector<float>& depths, std::size_t first, std::size_t end, float t) {
        const D d;
        for (; first < end; first += hn::Lanes(d)) {
            const std::intptr_t lane = hn::FindFirstTrue(d, hn::Ge(hn::LoadU(d, &depths[first]), hn::Set(d, t)));
            if (lane >= 0) return std::min(end, first + static_cast<std::size_t>(lane));
        }
        return end;
    }

    /// Leaves balls behind that end before depth t; they stay listed for the refinement.
    void pass(float t) { first_ = firstBeyond(near_.farDepth, first_, begun_, t); }

    /// No ball is near: moves to the last sample before the next ball. False when there is none.
    bool leap(long& k) {
        while (begun_ == near_.count && sieved_ < balls_.size()) takeIn();
        if (begun_ == near_.count) return false;
        k = std::max(k, sampleBefore(near_.nearDepth[begun_]) - 1);
        return true;
    }

    Root rootOf(std::size_t b, V t) const {
        const D d;
        const float* lanes = &near_.lanes[3 * b * hn::Lanes(d)];
        const V s = hn::Load(d, lanes + 2 * hn::Lanes(d));
        const V u = hn::Sub(hn::Mul(t, s), hn::Load(d, lanes + hn::Lanes(d)));
        return {hn::Sub(hn::Load(d, lanes), hn::Mul(u, u)), hn::Mul(u, s)};
    }

    Value at(V t) const { return sum(t, first_); }
    Sample sampleAt(V t) const { return {t, at(t)}; }

    Value sum(V t, std::size_t begin) const {
        const D d;
        V field = hn::Zero(d);
        V slope = hn::Zero(d);
        for (std::size_t b = begin; b < begun_; ++b) {
            const Root ball = rootOf(b, t);
            const V k = hn::Max(ball.root, hn::Zero(d));
            field = hn::Add(field, hn::Mul(k, k));
            slope = hn::Sub(slope, hn::Mul(k, ball.turn));
        }
        return {field, hn::Mul(slope, hn::Set(d, 4.0F))};
    }

    /// Rising at the first sample, falling at the second, and the tangents meet above the threshold:
    /// F0 + F0' x = F1 - F1' (h - x) at the height (F1 F0' - F0 F1' - F0' F1' h) / (F0' - F1').
    M mayPeak(const Value& a, const Value& b, float h) const {
        const D d;
        const V zero = hn::Zero(d);
        const V product = hn::Mul(hn::Mul(a.slope, b.slope), hn::Set(d, h));
        const V height = hn::Sub(hn::Sub(hn::Mul(b.field, a.slope), hn::Mul(a.field, b.slope)), product);
        const V limit = hn::Mul(hn::Set(d, cast_.threshold), hn::Sub(a.slope, b.slope));
        return hn::And(hn::And(hn::Gt(a.slope, zero), hn::Lt(b.slope, zero)), hn::Gt(height, limit));
    }

    /// Where F' changes sign, by bisection.
    V peakBetween(float from, float to) const {
        const D d;
        V low = hn::Set(d, from);
        V high = hn::Set(d, to);
        for (int k = 0; k < kPeakSearches; ++k) {
            const V middle = hn::Mul(hn::Add(low, high), hn::Set(d, 0.5F));
            const M rising = hn::Gt(at(middle).slope, hn::Zero(d));
            low = hn::IfThenElse(rising, middle, low);
            high = hn::IfThenElse(rising, high, middle);
        }
        return hn::Mul(hn::Add(low, high), hn::Set(d, 0.5F));
    }

    /// Where the cubic through two samples, with their slopes, meets the threshold: Newton's method from the chord's
    /// place, kept between the samples.
    V guess(const Sample& low, const Sample& high) const {
        const D d;
        const V zero = hn::Zero(d);
        const V one = hn::Set(d, 1.0F);
        const V tiny = hn::Set(d, 1e-20F);
        const V width = hn::Sub(high.depth, low.depth);
        const V rise = hn::Sub(high.value.field, low.value.field);
        const V first = hn::Mul(low.value.slope, width);
        const V last = hn::Mul(high.value.slope, width);
        // low + first u + square u^2 + cube u^3 for u from 0 to 1.
        const V cube = hn::Sub(hn::Add(first, last), hn::Add(rise, rise));
        const V square = hn::Sub(rise, hn::Add(first, cube));
        const V missing = hn::Sub(hn::Set(d, cast_.threshold), low.value.field);
        V u = hn::Min(hn::Div(missing, hn::Max(rise, tiny)), one);
        for (int k = 0; k < kGuesses; ++k) {
            const V value = hn::Mul(u, hn::Add(first, hn::Mul(u, hn::Add(square, hn::Mul(u, cube)))));
            const V twice = hn::Add(hn::Add(square, square), hn::Mul(hn::Set(d, 3.0F), hn::Mul(u, cube)));
            const V slope = hn::Add(first, hn::Mul(u, twice));
            const V next = hn::Add(u, hn::Div(hn::Sub(missing, value), hn::Max(slope, tiny)));
            u = hn::Min(hn::Max(next, zero), one);
        }
        return hn::Add(low.depth, hn::Mul(u, width));
    }

    /// Newton's method inside the bracket, ray by ray until a step was small; a step that would leave the bracket is
    /// replaced by its middle.
    V refine(const Sample& from, const Sample& to) const {
        const D d;
        const V small = hn::Set(d, kSmallStep * cast_.step);
        V low = from.depth;
        V high = to.depth;
        V t = guess(from, to);
        M rough = hn::FirstN(d, hn::Lanes(d));
        for (int k = 0; k < kRefinements; ++k) {
            const Value value = sum(t, firstFound_);
            const V over = hn::Sub(value.field, hn::Set(d, cast_.threshold));
            const M beyond = hn::Ge(over, hn::Zero(d));
            high = hn::IfThenElse(beyond, t, high);
            low = hn::IfThenElse(beyond, low, t);
            const V newton = hn::Sub(t, hn::Div(over, hn::Max(value.slope, hn::Set(d, 1e-20F))));
            const M good = hn::And(hn::Ge(newton, low), hn::Le(newton, high));
            const V middle = hn::Mul(hn::Add(low, high), hn::Set(d, 0.5F));
            const V next = hn::IfThenElse(rough, hn::IfThenElse(good, newton, middle), t);
            // Half of the bracket is left after a step to its middle.
            const V left = hn::IfThenElse(good, hn::Abs(hn::Sub(next, t)), hn::Sub(high, low));
            rough = hn::And(rough, hn::Gt(left, small));
            t = next;
            if (hn::AllFalse(d, rough)) break;
        }
        return t;
    }

    const FieldCast& cast_;
    TileBalls& balls_;
    NearBalls& near_;
    float start_;                 // where the tile's samples begin
    long begin_;                  // the first sample of these rays
    Sieve sieve_;                 // of the tile's balls
    std::size_t sieved_ = 0;      // those of them that went through it
    std::size_t begun_ = 0;       // near balls before it begin before the present depth
    std::size_t first_ = 0;       // those before it end there, too
    std::size_t firstFound_ = 0;  // first_ when the first lane met the surface
    V directionX_, directionY_, originX_, originY_, length_, inverseSquare_;
    V most_;
};

void castBlock(const FieldCast& cast, std::size_t tile, RayBlock& block) {
    const D d;
    const std::size_t lanes = hn::Lanes(d);
    if (block.count == 0) return;
    thread_local TileBalls balls;
    thread_local NearBalls near;
    balls.begin(cast, tile);
    for (std::size_t place = 0; place < block.count; place += lanes) {
        const M open = hn::FirstN(d, std::min(lanes, block.count - place));
        const V from = hn::Load(d, &block.from[place]);
        const ImagePoint at = imagePointAt(cast.frame, hn::Load(d, &block.x[place]), hn::Load(d, &block.y[place]));
        Group group(cast, balls, near, at, open, from);
        const V depth = group.cast(open, from, hn::Load(d, &block.to[place]));
        hn::StoreU(depth, d, &block.depth[place]);
        hn::StoreU(group.most(), d, &block.most[place]);
        if (!cast.looks.empty() && !hn::AllTrue(d, hn::Lt(depth, hn::Zero(d)))) group.look(depth, place, block);
    }
}

const char* castInstructionSet() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(castBlock);
HWY_EXPORT(castInstructionSet);

void castBlock(const FieldCast& cast, std::size_t tile, RayBlock& block) {
    HWY_DYNAMIC_DISPATCH(castBlock)(cast, tile, block);
}

const char* castInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(castInstructionSet)();
}

}  // namespace render

#endif
