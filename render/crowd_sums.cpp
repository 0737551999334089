// Sixteen sums side by side, however many lanes there are, and their sum in a fixed order, so that every instruction
// set gives the same bits; this file is compiled once per instruction set.
#include "render/crowd_sums.h"

#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/crowd_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/lane_rays-inl.h"

#ifndef RENDER_CROWD_BLOCK
#define RENDER_CROWD_BLOCK
namespace render {
inline constexpr std::size_t kCrowdBlock = 16;
}
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr std::size_t kParts = kCrowdBlock / hn::MaxLanes(D());

float sumOf(const V* parts) {
    alignas(64) std::array<float, kCrowdBlock> sums;
    for (std::size_t part = 0; part < kParts; ++part) hn::Store(parts[part], D(), &sums[part * hn::Lanes(D())]);
    for (std::size_t half = kCrowdBlock / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < half; ++k) sums[k] += sums[k + half];
    return sums[0];
}

CrowdSum sumOver(const Crowd& crowd, glm::vec4 particle, float reach) {
    const D d;
    const Vec3 here = uniform(glm::vec3(particle));
    const V zero = all(0.0F);
    const V one = all(1.0F);
    V share[kParts], pullX[kParts], pullY[kParts], pullZ[kParts];
    for (std::size_t part = 0; part < kParts; ++part) share[part] = pullX[part] = pullY[part] = pullZ[part] = zero;
    for (std::size_t block = 0; block < crowd.size(); block += kCrowdBlock) {
        for (std::size_t part = 0; part < kParts; ++part) {
            const std::size_t k = block + part * hn::Lanes(d);
            const Vec3 off{hn::Sub(hn::LoadU(d, crowd.x() + k), here.x), hn::Sub(hn::LoadU(d, crowd.y() + k), here.y),
                           hn::Sub(hn::LoadU(d, crowd.z() + k), here.z)};
            const V far = hn::Mul(all(0.5F * reach), hn::Add(all(particle.w), hn::LoadU(d, crowd.radius() + k)));
            const V root = hn::Max(zero, hn::Sub(one, hn::Div(dotted(off, off), hn::Mul(far, far))));
            const V weight = hn::Mul(root, root);
            share[part] = hn::Add(share[part], weight);
            pullX[part] = hn::Add(pullX[part], hn::Mul(weight, off.x));
            pullY[part] = hn::Add(pullY[part], hn::Mul(weight, off.y));
            pullZ[part] = hn::Add(pullZ[part], hn::Mul(weight, off.z));
        }
    }
    return {sumOf(share), {sumOf(pullX), sumOf(pullY), sumOf(pullZ)}};
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(sumOver);

CrowdSum sumOver(const Crowd& crowd, glm::vec4 particle, float reach) {
    if (crowd.size() % kCrowdBlock != 0) throw std::logic_error("render: sums over a crowd that is not finished");
    return HWY_DYNAMIC_DISPATCH(sumOver)(crowd, particle, reach);
}

void Crowd::add(std::span<const glm::vec4> places) {
    if (x_.size() < count_ + places.size())
        for (std::vector<float>* values : {&x_, &y_, &z_, &radius_}) values->resize(2 * (count_ + places.size()));
    for (const glm::vec4& place : places) {
        x_[count_] = place.x;
        y_[count_] = place.y;
        z_[count_] = place.z;
        radius_[count_++] = place.w;
    }
}

void Crowd::finish() {
    // Far beyond any reach, and its distance squared still a number.
    constexpr glm::vec4 kNobody(1e18F, 1e18F, 1e18F, 0.0F);
    while (count_ % kCrowdBlock != 0) add({&kNobody, 1});
}

}  // namespace render

#endif
