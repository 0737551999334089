// The boxes that cast shadows by section 4 of render/picture/shading_model.h, each with the sign of its coverage.
// Header only: it is used by the oracle alone.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace oracle {

/// A box whose coverage of the light is added (sign 1) or subtracted (sign -1).
struct SignedBox {
    render::BoxObstacle box;
    double sign = 1.0;
};

/// The part that two boxes share; minimum > maximum along some axis if they share none.
inline render::BoxObstacle intersection(const render::BoxObstacle& a, const render::BoxObstacle& b) {
    return {glm::max(a.minimum, b.minimum), glm::min(a.maximum, b.maximum)};
}

inline bool isSame(const render::BoxObstacle& a, const render::BoxObstacle& b) {
    return a.minimum == b.minimum && a.maximum == b.maximum;
}

/// The groups of boxes that touch or overlap, directly or through others.
inline std::vector<std::vector<render::BoxObstacle>> groupsOf(const std::vector<render::BoxObstacle>& boxes) {
    std::vector<std::vector<render::BoxObstacle>> groups;
    std::vector<bool> isTaken(boxes.size(), false);
    for (std::size_t first = 0; first < boxes.size(); ++first) {
        if (isTaken[first]) continue;
        std::vector<bool> isIn(boxes.size(), false);
        isIn[first] = true;
        for (bool grows = true; grows;) {
            grows = false;
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                for (std::size_t other = 0; other < boxes.size() && !isIn[k]; ++other) {
                    const render::BoxObstacle shared = intersection(boxes[k], boxes[other]);
                    if (!isIn[other] || glm::any(glm::greaterThan(shared.minimum, shared.maximum))) continue;
                    isIn[k] = grows = true;
                }
            }
        }
        groups.emplace_back();
        for (std::size_t k = 0; k < boxes.size(); ++k)
            if (isIn[k]) {
                isTaken[k] = true;
                groups.back().push_back(boxes[k]);
            }
    }
    return groups;
}

/// Grows the boxes of a group through each other.
inline void growBoxes(std::vector<render::BoxObstacle>& group) {
    const std::vector<render::BoxObstacle> before = group;
    for (render::BoxObstacle& box : group)
        for (int axis = 0; axis < 3; ++axis)
            for (const bool isPlus : {true, false})
                for (const render::BoxObstacle& other : group) {
                    // The face itself, as a flat box, lies in the other box.
                    render::BoxObstacle face = box;
                    (isPlus ? face.minimum : face.maximum)[axis] = isPlus ? box.maximum[axis] : box.minimum[axis];
                    if (!isSame(intersection(face, other), face)) continue;
                    if (isPlus) box.maximum[axis] = other.maximum[axis];
                    if (!isPlus) box.minimum[axis] = other.minimum[axis];
                }
    for (std::size_t k = 0; k < group.size(); ++k)
        if (!isSame(group[k], before[k])) return growBoxes(group);
}

/// The terms of inclusion and exclusion of a group of boxes.
inline std::vector<SignedBox> termsOf(const std::vector<render::BoxObstacle>& group) {
    std::vector<SignedBox> unjoined;
    for (const render::BoxObstacle& box : group) unjoined.push_back({box, 1.0});
    if (group.size() > 256) return unjoined;
    std::vector<render::BoxObstacle> grown = group;
    growBoxes(grown);
    std::vector<render::BoxObstacle> outer;
    for (std::size_t k = 0; k < grown.size(); ++k) {
        bool isInOther = false;
        for (std::size_t other = 0; other < grown.size(); ++other)
            if (other != k && isSame(intersection(grown[k], grown[other]), grown[k]))
                isInOther = isInOther || other < k || !isSame(grown[k], grown[other]);
        if (!isInOther) outer.push_back(grown[k]);
    }
    // Each box turns all terms so far into as many more: their intersections with it, with the other sign.
    std::vector<SignedBox> terms;
    for (const render::BoxObstacle& box : outer) {
        const std::size_t before = terms.size();
        terms.push_back({box, 1.0});
        for (std::size_t k = 0; k < before; ++k) {
            const render::BoxObstacle shared = intersection(terms[k].box, box);
            if (glm::all(glm::lessThan(shared.minimum, shared.maximum))) terms.push_back({shared, -terms[k].sign});
        }
        if (terms.size() > 16 * outer.size()) return unjoined;
    }
    return terms;
}

/// The boxes that cast the shadows of a view's boxes.
inline std::vector<SignedBox> shadowBoxes(const std::vector<render::BoxObstacle>& boxes) {
    std::vector<SignedBox> all;
    for (const std::vector<render::BoxObstacle>& group : groupsOf(boxes))
        for (const SignedBox& term : termsOf(group)) all.push_back(term);
    return all;
}

}  // namespace oracle
