// Inclusion and exclusion: what two boxes cover together is the sum of what each covers less what both cover, which
// their intersection, a box as well, stands for. Where outlines of neighbors run along one line, it ends in the same
// corner as one of them, so that the corner cancels. Boxes are grown through their neighbors before, because boxes that
// only touch have no intersection.
#include "render/prepare/lighting/shadow_boxes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace render {

namespace {

using Boxes = std::vector<BoxObstacle>;

bool touches(const BoxObstacle& a, const BoxObstacle& b) {
    return all(lessThanEqual(a.minimum, b.maximum)) && all(lessThanEqual(b.minimum, a.maximum));
}

bool contains(const BoxObstacle& outer, const BoxObstacle& inner) {
    return all(lessThanEqual(outer.minimum, inner.minimum)) && all(lessThanEqual(inner.maximum, outer.maximum));
}

/// The group of each box: the least index of a box that it is connected to by boxes that touch.
class Groups {
 public:
    explicit Groups(std::span<const BoxObstacle> boxes) : parents_(boxes.size()) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
        std::vector<std::size_t> order = parents_;
        std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(boxes[k].minimum.x, k); });
        std::vector<std::size_t> open;  // boxes that reach as far along x as the next one
        for (const std::size_t next : order) {
            std::erase_if(open, [&](std::size_t k) { return boxes[k].maximum.x < boxes[next].minimum.x; });
            for (const std::size_t other : open)
                if (touches(boxes[other], boxes[next])) join(other, next);
            open.push_back(next);
        }
    }

    std::size_t of(std::size_t box) {
        while (parents_[box] != box) box = parents_[box] = parents_[parents_[box]];
        return box;
    }

 private:
    void join(std::size_t a, std::size_t b) {
        const std::size_t ofA = of(a);
        const std::size_t ofB = of(b);
        parents_[std::max(ofA, ofB)] = std::min(ofA, ofB);
    }

    std::vector<std::size_t> parents_;
};

/// Moves one face of a box to the far side of a neighbor if the whole face lies in it.
bool growThrough(const BoxObstacle& neighbor, int axis, bool isPlus, BoxObstacle& box) {
    const float face = isPlus ? box.maximum[axis] : box.minimum[axis];
    const float farSide = isPlus ? neighbor.maximum[axis] : neighbor.minimum[axis];
    if (isPlus ? farSide <= face || neighbor.minimum[axis] > face : farSide >= face || neighbor.maximum[axis] < face)
        return false;
    for (int other = 0; other < 3; ++other)
        if (other != axis &&
            (neighbor.minimum[other] > box.minimum[other] || neighbor.maximum[other] < box.maximum[other]))
            return false;
    (isPlus ? box.maximum : box.minimum)[axis] = farSide;
    return true;
}

/// Grows the boxes of a group through each other, until no face moves any more. What they fill together stays the same.
void grow(Boxes& group) {
    for (bool isMoved = true; isMoved;) {
        isMoved = false;
        for (BoxObstacle& box : group)
            for (int face = 0; face < 6; ++face)
                for (const BoxObstacle& neighbor : group)
                    if (growThrough(neighbor, face / 2, face % 2 == 0, box)) isMoved = true;
    }
}

/// Leaves out boxes that lie within others; of equal ones all but the first.
Boxes withoutContained(const Boxes& group) {
    Boxes kept;
    for (std::size_t k = 0; k < group.size(); ++k) {
        const auto isIn = [&](std::size_t other) {
            return other != k && contains(group[other], group[k]) && (other < k || !contains(group[k], group[other]));
        };
        bool isContained = false;
        for (std::size_t other = 0; other < group.size(); ++other) isContained = isContained || isIn(other);
        if (!isContained) kept.push_back(group[k]);
    }
    return kept;
}

/// The terms of a group: the intersections of an odd number of boxes are added, of an even number subtracted.
struct Terms {
    Boxes added, subtracted;

    std::size_t count() const { return added.size() + subtracted.size(); }

    /// Adds a term, and those of its intersections with the boxes from an index on, until there are too many.
    void add(const Boxes& group, const BoxObstacle& term, bool isAdded, std::size_t next) {
        (isAdded ? added : subtracted).push_back(term);
        for (; next < group.size() && count() <= kMostTermsPerBox * group.size(); ++next) {
            const glm::vec3 low = max(term.minimum, group[next].minimum);
            const glm::vec3 high = min(term.maximum, group[next].maximum);
            if (all(lessThan(low, high))) add(group, {low, high}, !isAdded, next + 1);
        }
    }
};

/// The terms of a group, or nothing but its boxes if there are too many.
Terms termsOf(const Boxes& group) {
    if (group.size() == 1 || group.size() > kMostJoinedBoxes) return {group, {}};
    Boxes grown = group;
    grow(grown);
    grown = withoutContained(grown);
    Terms terms;
    for (std::size_t k = 0; k < grown.size(); ++k) terms.add(grown, grown[k], true, k + 1);
    return terms.count() > kMostTermsPerBox * grown.size() ? Terms{group, {}} : terms;
}

}  // namespace

ShadowBoxes shadowBoxes(std::span<const BoxObstacle> boxes) {
    Groups groups(boxes);
    std::vector<Boxes> members(boxes.size());  // of each group, under its first box
    for (std::size_t k = 0; k < boxes.size(); ++k) members[groups.of(k)].push_back(boxes[k]);
    Terms all;
    for (const Boxes& group : members) {
        if (group.empty()) continue;
        const Terms terms = termsOf(group);
        all.added.insert(all.added.end(), terms.added.begin(), terms.added.end());
        all.subtracted.insert(all.subtracted.end(), terms.subtracted.begin(), terms.subtracted.end());
    }
    ShadowBoxes found{std::move(all.subtracted), 0};
    found.subtractedCount = found.boxes.size();
    found.boxes.insert(found.boxes.end(), all.added.begin(), all.added.end());
    return found;
}

}  // namespace render
