// What can be seen lies in the picture's volume: the pyramid of all rays in perspective, a prism in parallel
// projection. A shadow is a cylinder from its caster away from the light. It falls on something that is seen if it
// meets both the picture's volume and the box around the thing, which are convex: the axis of the cylinder is clipped
// by their faces, moved outward by the radius of the cylinder.
#include "render/prepare/cells/strays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/picture/drawn_meshes.h"
#include "render/prepare/cells/tiles.h"

namespace render {

namespace {

using Extent = Bounds<glm::vec3>;

/// A half space: the points p with dot(normal, p) + offset >= 0. The normal has unit length.
struct HalfSpace {
    glm::vec3 normal{0.0F};
    float offset = 0.0F;

    float distanceInside(glm::vec3 point) const { return dot(normal, point) + offset; }
};

/// The half spaces whose intersection a picture shows, two pixels wider on each side; relative to the eye.
std::array<HalfSpace, 5> pictureVolume(const CameraFrame& frame) {
    const float width = frame.halfWidth * (1.0F + 4.0F / static_cast<float>(frame.width));
    const float height = frame.halfHeight * (1.0F + 4.0F / static_cast<float>(frame.height));
    const auto side = [&](glm::vec3 outward, float half) {
        if (!frame.perspective) return HalfSpace{-outward, half};
        return HalfSpace{normalize(half * frame.forward - outward), 0.0F};
    };
    const glm::vec2 middle = frame.middle;
    return {HalfSpace{frame.forward, 0.0F}, side(frame.right, width + middle.x), side(-frame.right, width - middle.x),
            side(frame.up, height + middle.y), side(-frame.up, height - middle.y)};
}

/// A particle or a sphere obstacle.
struct Ball {
    glm::vec3 center{0.0F};  ///< relative to the eye, m
    float radius = 0.0F;     ///< of what is drawn, m
    float reach = 0.0F;      ///< how far from the center it may change the picture, m
};

/// The part of a ray at distances from `first` to `second` from its start; empty where first > second.
using RayPart = std::pair<float, float>;

/// Clips a ray to the points at most `slack` outside of a half space.
void clipRay(const HalfSpace& half, glm::vec3 start, glm::vec3 direction, float slack, RayPart& part) {
    const float room = half.distanceInside(start) + slack;
    const float slope = dot(half.normal, direction);
    if (slope > 0.0F)
        part.first = std::max(part.first, -room / slope);
    else if (slope < 0.0F)
        part.second = std::min(part.second, -room / slope);
    else if (!(room >= 0.0F))
        part.second = -1.0F;
}

/// What a picture shows, and what may shade it.
class VisibleVolume {
 public:
    VisibleVolume(const CameraFrame& frame, const View& view)
        : frame_(frame), volume_(pictureVolume(frame)), toLight_(normalize(view.light.toLight)), ground_(view.ground) {
        if (ground_) ground_->height -= frame.eye.y;
        if (ground_) ground_->center -= frame.eye;
        hasShadows_ = view.light.shadows;
        for (const BoxObstacle& box : view.boxObstacles)
            if (pixelsTouchedByBox(frame, box.minimum, box.maximum))
                addReceiver({box.minimum - frame.eye, box.maximum - frame.eye});
        for (const MeshObstacle& obstacle : view.meshObstacles) {
            const Bounds<glm::vec3> box = boundsOf(obstacle);
            if (box.low.x <= box.high.x && pixelsTouchedByBox(frame, box.low, box.high))
                addReceiver({box.low - frame.eye, box.high - frame.eye});
        }
    }

    /// Whether a sphere may touch the picture. @param center  relative to the eye
    bool shows(glm::vec3 center, float radius) const {
        return std::ranges::all_of(volume_,
                                   [&](const HalfSpace& half) { return half.distanceInside(center) >= -radius; });
    }

    /// Adds a box around something that is seen and may lie in shadow.
    void addReceiver(const Extent& box) {
        receivers_.push_back(box);
        allReceivers_.add(box.low, box.high);
    }

    /// Whether the picture may change with a ball: by what is drawn of it, by the sky that it hides or by its shadow.
    bool isChangedBy(const Ball& ball) const {
        return shows(ball.center, ball.reach) || (hasShadows_ && (shadesGround(ball) || shadesReceiver(ball)));
    }

 private:
    // Chosen: single precision places a shadow from so far away to a thousandth of the radius of what casts it, and no
    // real light casts one from there.
    static constexpr float kFarthestShadow = 2048.0F;  // radii

    // Farther from its center the ground has less than a ten-thousandth of its own color: not one step of a pixel's
    // color.
    static constexpr float kFadedGround = 10.0F;  // fade distances

    /// Whether a shadow of this radius is too narrow to be seen at a view depth.
    bool isTooNarrow(float radius, float depth) const {
        return radius < 0.25F * frame_.pixelWidth() * (frame_.perspective ? std::max(depth, 0.0F) : 1.0F);
    }

    bool shadesGround(const Ball& ball) const {
        if (!ground_ || toLight_.y <= 0.0F || ball.center.y + ball.reach < ground_->height) return false;
        // On the ground the shadow is an ellipse that is longer by this factor than wide.
        const float stretch = 1.0F / toLight_.y;
        const float distance = (ball.center.y - ground_->height) * stretch;
        const glm::vec3 middle = ball.center - distance * toLight_;
        const float faded = kFadedGround * ground_->fadeDistance + ball.reach * stretch;
        return distance <= kFarthestShadow * ball.radius && shows(middle, ball.reach * stretch) &&
               glm::distance(middle, ground_->center) <= faded &&
               !isTooNarrow(ball.radius * stretch, dot(middle, frame_.forward) - ball.reach * stretch);
    }

    bool shadesReceiver(const Ball& ball) const {
        RayPart seen{0.0F, kFarthestShadow * ball.radius};
        for (const HalfSpace& half : volume_) clipRay(half, ball.center, -toLight_, ball.reach, seen);
        RayPart near = seen;
        if (!meets(ball, allReceivers_, near)) return false;
        return std::ranges::any_of(receivers_, [&](const Extent& box) {
            RayPart part = seen;
            if (!meets(ball, box, part)) return false;
            const auto depthAt = [&](float distance) { return dot(ball.center - distance * toLight_, frame_.forward); };
            return !isTooNarrow(ball.radius, std::min(depthAt(part.first), depthAt(part.second)));
        });
    }

    /// Clips a part of the axis of a ball's shadow to where the shadow may meet a box. @return whether anything is left
    bool meets(const Ball& ball, const Extent& box, RayPart& part) const {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 along(0.0F);
            along[axis] = 1.0F;
            clipRay({along, -box.low[axis]}, ball.center, -toLight_, ball.reach, part);
            clipRay({-along, box.high[axis]}, ball.center, -toLight_, ball.reach, part);
        }
        return part.first <= part.second;
    }

    const CameraFrame& frame_;
    std::array<HalfSpace, 5> volume_;
    glm::vec3 toLight_;
    std::optional<Ground> ground_;  // relative to the eye
    bool hasShadows_ = true;
    std::vector<Extent> receivers_;  // relative to the eye
    Extent allReceivers_;            // the box around all of them
};

/// The box in which nothing is a stray. @param box  around the particles that are seen
Extent surroundings(const Extent& box) {
    const glm::vec3 size = box.high - box.low;
    const float margin = 0.5F * std::max({size.x, size.y, size.z});
    return {box.low - margin, box.high + margin};
}

bool contains(const Extent& box, glm::vec3 point) {
    return all(greaterThanEqual(point, box.low)) && all(lessThanEqual(point, box.high));
}

/// Whether everything lies in the surroundings of some particles that are seen, so that there are no strays. That is so
/// in most views, and is found in a fraction of the time that testing every particle takes.
bool isCompact(const View& view, const VisibleVolume& visible, glm::vec3 eye) {
    constexpr std::size_t kSamples = 1024;  // number of particles tested, or a few less; chosen
    const std::size_t step = view.particles.size() / kSamples + 1;
    Extent seen;
    for (std::size_t k = 0; k < view.particles.size(); k += step) {
        const glm::vec3 center = view.particles[k].center - eye;
        if (visible.shows(center, view.particles[k].radius)) seen.add(center);
    }
    if (seen.high.x < seen.low.x) return false;
    Extent all;
    for (const Sphere& particle : view.particles) all.add(particle.center - eye);
    for (const SphereObstacle& sphere : view.sphereObstacles) all.add(sphere.center - eye);
    const Extent around = surroundings(seen);
    return contains(around, all.low) && contains(around, all.high);
}

/// The particles of a view, then its sphere obstacles. `reach` is `radius` at first.
std::vector<Ball> ballsOf(const View& view, glm::vec3 eye) {
    std::vector<Ball> balls;
    balls.reserve(view.particles.size() + view.sphereObstacles.size());
    const float drawn = view.style == Style::metaballs ? view.field.reach : 1.0F;
    for (const Sphere& particle : view.particles)
        balls.push_back({particle.center - eye, drawn * particle.radius, drawn * particle.radius});
    for (const SphereObstacle& sphere : view.sphereObstacles)
        balls.push_back({sphere.center - eye, sphere.radius, sphere.radius});
    return balls;
}

/// 1 for each ball that passes a test, 0 for the others.
template <typename Test>
std::vector<std::uint8_t> flagsOf(std::span<const Ball> balls, const Test& test) {
    std::vector<std::uint8_t> flags(balls.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, balls.size(), 4096), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) flags[k] = test(balls[k]) ? 1 : 0;
    });
    return flags;
}

/// The box around what is drawn of the flagged balls. @param flags  of the first balls; the others are left out
Extent boxAround(std::span<const Ball> balls, std::span<const std::uint8_t> flags) {
    Extent box;
    for (std::size_t k = 0; k < flags.size(); ++k)
        if (flags[k] != 0) box.add(balls[k].center - balls[k].radius, balls[k].center + balls[k].radius);
    return box;
}

/// Adds to the reach of each ball the width of soft shadows, and the distance from which particles hide the sky from
/// others or pull the balls of a smooth skin.
/// @param seen  flags of the particles that are seen
void addInfluence(std::span<const std::uint8_t> seen, Skin skin, std::span<Ball> balls) {
    double sum = 0.0;
    double count = 0.0;
    float largest = 0.0F;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        if (seen[k] == 0) continue;
        sum += double(balls[k].radius);
        largest = std::max(largest, balls[k].radius);
        ++count;
    }
    // Ten cubes of shading_model.h, each at most 2.4 mean radii wide, along each of the three axes; and twice the reach
    // of the field, because a particle that is not seen may pull one that is. In an anisotropic skin it may from twice
    // as far, also through a third one, and the ball that it pulls may be some three times as long as its reach.
    const float pull = skin == Skin::anisotropic ? 6.0F : 2.0F;
    const float influence = static_cast<float>(42.0 * sum / std::max(count, 1.0)) + pull * largest;
    for (Ball& ball : balls) ball.reach = 1.61F * ball.radius + influence;  // 1.61: as in light_space.cpp
}

template <typename Item>
void keepFlagged(std::span<const std::uint8_t> flags, std::vector<Item>& items) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < items.size(); ++k)
        if (flags[k] != 0) items[count++] = items[k];
    items.resize(count);
}

/// Flags the balls that are no strays.
std::vector<std::uint8_t> flagsOfKept(const View& view, glm::vec3 eye, VisibleVolume& visible) {
    std::vector<Ball> balls = ballsOf(view, eye);
    const std::size_t particles = view.particles.size();
    const auto seen = flagsOf(balls, [&](const Ball& ball) { return visible.shows(ball.center, ball.radius); });
    const auto seenParticles = std::span(seen).first(particles);
    const Extent box = boxAround(balls, seenParticles);
    if (box.high.x < box.low.x) return std::vector<std::uint8_t>(balls.size(), 1);
    visible.addReceiver(box);
    for (std::size_t k = particles; k < balls.size(); ++k)
        if (seen[k] != 0) visible.addReceiver({balls[k].center - balls[k].radius, balls[k].center + balls[k].radius});
    addInfluence(seenParticles, view.field.skin, balls);
    const Extent around = surroundings(box);
    return flagsOf(balls, [&](const Ball& ball) { return contains(around, ball.center) || visible.isChangedBy(ball); });
}

using Group = std::vector<std::uint32_t>;

bool isSmall(const Bounds<glm::vec3>& box, float gap, double mostCells) {
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis)
        count *= std::floor(double(box.high[axis] - box.low[axis]) / double(gap)) + 1.0;
    return count <= mostCells;
}

bool isSmall(std::span<const Sphere> particles, const Group& group, float gap, double mostCells) {
    Bounds<glm::vec3> box;
    for (const std::uint32_t index : group) box.add(particles[index].center);
    return isSmall(box, gap, mostCells);
}

/// The parts of a group between its gaps along an axis. @param group  is left in the order of the coordinates
std::vector<Group> partsAlong(std::span<const Sphere> particles, int axis, float gap, Group& group) {
    const auto at = [&](std::uint32_t index) { return particles[index].center[axis]; };
    std::ranges::sort(group, {}, at);
    std::vector<Group> parts;
    for (std::size_t begin = 0; begin < group.size();) {
        std::size_t end = begin + 1;
        while (end < group.size() && !(at(group[end]) - at(group[end - 1]) > gap)) ++end;
        parts.emplace_back(group.begin() + static_cast<std::ptrdiff_t>(begin),
                           group.begin() + static_cast<std::ptrdiff_t>(end));
        begin = end;
    }
    return parts;
}

/// The parts of a group between its gaps along the first axis that has any; one part if there are none.
std::vector<Group> partsOf(std::span<const Sphere> particles, float gap, Group& group) {
    std::vector<Group> parts;
    for (int axis = 0; axis < 3 && parts.size() < 2; ++axis) parts = partsAlong(particles, axis, gap, group);
    return parts;
}

}  // namespace

std::optional<View> withoutStrays(const View& view, const CameraFrame& frame) {
    VisibleVolume visible(frame, view);
    if (isCompact(view, visible, frame.eye)) return std::nullopt;
    const std::vector<std::uint8_t> kept = flagsOfKept(view, frame.eye, visible);
    if (std::ranges::find(kept, 0) == kept.end()) return std::nullopt;
    View near = view;
    keepFlagged(std::span(kept).first(view.particles.size()), near.particles);
    keepFlagged(std::span(kept).first(near.particleIds.size()), near.particleIds);
    keepFlagged(std::span(kept).subspan(view.particles.size()), near.sphereObstacles);
    return near;
}

std::vector<Group> separateGroups(std::span<const Sphere> particles, float gap, double mostCells) {
    Bounds<glm::vec3> all;
    for (const Sphere& particle : particles) all.add(particle.center);
    if (isSmall(all, gap, mostCells)) return {};
    std::vector<Group> pending(1, Group(particles.size()));
    std::iota(pending.front().begin(), pending.front().end(), 0U);
    std::vector<Group> groups;
    while (!pending.empty()) {
        Group group = std::move(pending.back());
        pending.pop_back();
        std::vector<Group> parts;
        if (!isSmall(particles, group, gap, mostCells)) parts = partsOf(particles, gap, group);
        if (parts.size() > 1) {
            std::ranges::move(parts, std::back_inserter(pending));
            continue;
        }
        std::ranges::sort(group);
        groups.push_back(std::move(group));
    }
    return groups.size() > 1 ? groups : std::vector<Group>();
}

}  // namespace render
