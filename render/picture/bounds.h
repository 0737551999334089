// Rectangles and boxes that grow to hold points.
#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace render {

/// An axis-aligned rectangle or box, empty at first.
template <typename Vector>
struct Bounds {
    Vector low{std::numeric_limits<float>::max()};
    Vector high{std::numeric_limits<float>::lowest()};

    void add(Vector first, Vector last) {
        low = min(low, first);
        high = max(high, last);
    }
    void add(Vector point) { add(point, point); }
};

}  // namespace render
