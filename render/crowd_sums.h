// What the particles around others add up to, as many at a time as the machine has lanes. Called by skin.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// Particles side by side, in whole blocks for the lanes.
class Crowd {
 public:
    void clear() { count_ = 0; }

    /// places: center, radius.
    void add(std::span<const glm::vec4> places);

    /// To be called after the last add(): fills up to whole blocks with particles that reach nobody.
    void finish();

    std::size_t size() const { return count_; }
    const float* x() const { return x_.data(); }
    const float* y() const { return y_.data(); }
    const float* z() const { return z_.data(); }
    const float* radius() const { return radius_.data(); }

 private:
    std::size_t count_ = 0;
    std::vector<float> x_, y_, z_, radius_;  // with room for more than `count_`
};

/// With k = max(0, 1 - d^2 / reach^2)^2 of each particle in reach, which is so many mean radii of both.
struct CrowdSum {
    float crowd = 0.0F;    ///< sum of k
    glm::vec3 pull{0.0F};  ///< sum of k times the way there
};

/// Of a crowd that is finished; throws std::logic_error otherwise.
/// Holds:  the same bits on every instruction set.
CrowdSum sumOver(const Crowd& crowd, glm::vec4 particle, float reach);

}  // namespace render
