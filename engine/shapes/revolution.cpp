#include "engine/shapes/revolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace engine {
namespace {

/// Edges that are skipped together where their box is farther than the nearest edge found so far. Chosen: the box of
/// eight edges of a rounded corner is small, and a profile of 60 edges has eight boxes.
constexpr std::size_t kBlockSize = 8;

bool isOnAxis(const ProfilePoint& point) {
    return point.radius == 0.0;
}

bool areEqual(const ProfilePoint& a, const ProfilePoint& b) {
    return a.radius == b.radius && a.height == b.height;
}

/// Twice the area of a polygon, positive if its points run counterclockwise.
double twiceArea(const std::vector<ProfilePoint>& points) {
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const ProfilePoint& a = points[k];
        const ProfilePoint& b = points[(k + 1) % points.size()];
        sum += (a.radius - points[0].radius) * (b.height - points[0].height) -
               (b.radius - points[0].radius) * (a.height - points[0].height);
    }
    return sum;
}

/// The points, without those that follow an equal one.
std::vector<ProfilePoint> distinct(const std::vector<ProfilePoint>& points, bool isClosed) {
    std::vector<ProfilePoint> kept;
    for (const ProfilePoint& point : points) {
        if (!(std::isfinite(point.radius) && std::isfinite(point.height) && point.radius >= 0.0))
            throw std::invalid_argument("a point of a profile is not finite or has a negative radius");
        if (kept.empty() || !areEqual(kept.back(), point)) kept.push_back(point);
    }
    if (kept.empty()) throw std::invalid_argument("a profile has no points");
    while (isClosed && kept.size() > 1 && areEqual(kept.back(), kept.front())) kept.pop_back();
    return kept;
}

}  // namespace

Revolution::Revolution(const std::vector<ProfilePoint>& points, bool isClosed, double halfThickness)
    : isSolid_(isClosed && halfThickness == 0.0), halfThickness_(halfThickness) {
    std::vector<ProfilePoint> chain = distinct(points, isClosed);
    if (!isSolid_ && !(halfThickness > 0.0 && std::isfinite(halfThickness)))
        throw std::invalid_argument("an open profile has no thickness");
    const double area = isSolid_ ? twiceArea(chain) : 0.0;
    if (isSolid_ && (area == 0.0 || !std::isfinite(area))) throw std::invalid_argument("a closed profile has no area");
    // The normal (height, -radius) of an edge points out of a polygon that runs counterclockwise.
    if (area < 0.0) std::reverse(chain.begin(), chain.end());
    makeEdges(chain, isClosed && chain.size() > 2 && !(isOnAxis(chain.front()) && isOnAxis(chain.back())));
    makeBlocks();
}

Revolution::Edge Revolution::edgeBetween(const ProfilePoint& start, const ProfilePoint& end) {
    const double radius = end.radius - start.radius;
    const double height = end.height - start.height;
    const double length = std::sqrt(radius * radius + height * height);
    Edge edge;
    edge.start = {start.radius, start.height};
    edge.direction = length > 0.0 ? HalfPlaneVector{radius / length, height / length} : HalfPlaneVector{0.0, 1.0};
    edge.length = length;
    return edge;
}

// At a corner, the sum of the normals of both edges tells the inside from the outside: it has a positive component
// towards each outer point to which the corner is nearest, and a negative one towards each inner point. Where a single
// edge ends on the axis, the other is its mirror image, and the sum is along the axis.
void Revolution::makeEdges(const std::vector<ProfilePoint>& chain, bool isRing) {
    const std::size_t count = chain.size();
    std::vector<HalfPlaneVector> normals(count);
    std::vector<int> meeting(count, 0);
    std::vector<std::size_t> starts;
    for (std::size_t k = 0; k < std::max<std::size_t>(isRing ? count : count - 1, 1); ++k) {
        const std::size_t next = (k + 1) % count;
        if (isSolid_ && isOnAxis(chain[k]) && isOnAxis(chain[next])) continue;
        starts.push_back(k);
        edges_.push_back(edgeBetween(chain[k], chain[next]));
        for (const std::size_t corner : {k, next}) {
            normals[corner].radius += edges_.back().direction.height;
            normals[corner].height -= edges_.back().direction.radius;
            ++meeting[corner];
        }
    }
    for (std::size_t k = 0; k < count; ++k)
        if (isSolid_ && isOnAxis(chain[k]) && meeting[k] == 1) normals[k].radius = 0.0;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        edges_[k].startNormal = normals[starts[k]];
        edges_[k].endNormal = normals[(starts[k] + 1) % count];
    }
}

void Revolution::makeBlocks() {
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        const Edge& edge = edges_[k];
        const double endRadius = std::max(edge.start.radius + edge.length * edge.direction.radius, 0.0);
        const double endHeight = edge.start.height + edge.length * edge.direction.height;
        const Block box{{std::min(edge.start.radius, endRadius), std::min(edge.start.height, endHeight)},
                        {std::max(edge.start.radius, endRadius), std::max(edge.start.height, endHeight)}};
        if (k % kBlockSize == 0) {
            blocks_.push_back(box);
            continue;
        }
        Block& block = blocks_.back();
        block.low = {std::min(block.low.radius, box.low.radius), std::min(block.low.height, box.low.height)};
        block.high = {std::max(block.high.radius, box.high.radius), std::max(block.high.height, box.high.height)};
    }
}

BoundingBox Revolution::bounds() const {
    Block all = blocks_.front();
    for (const Block& block : blocks_) {
        all.low.height = std::min(all.low.height, block.low.height);
        all.high.height = std::max(all.high.height, block.high.height);
        all.high.radius = std::max(all.high.radius, block.high.radius);
    }
    const double radius = all.high.radius + halfThickness_;
    return {{-radius, all.low.height - halfThickness_, -radius}, {radius, all.high.height + halfThickness_, radius}};
}

double Revolution::thickness() const {
    return isSolid_ ? std::numeric_limits<double>::infinity() : 2.0 * halfThickness_;
}

void Revolution::searchBlock(std::size_t block, const HalfPlaneVector& point, Nearest& nearest) const {
    const std::size_t end = std::min((block + 1) * kBlockSize, edges_.size());
    for (std::size_t k = block * kBlockSize; k < end; ++k) {
        const Edge& edge = edges_[k];
        const double radius = point.radius - edge.start.radius;
        const double height = point.height - edge.start.height;
        const double projection = radius * edge.direction.radius + height * edge.direction.height;
        const double along = std::min(std::max(projection, 0.0), edge.length);
        const double across = radius * edge.direction.height - height * edge.direction.radius;
        const double beyond = projection - along;
        const double distanceSq = across * across + beyond * beyond;
        if (distanceSq < nearest.distanceSq) nearest = {distanceSq, &edge, along};
    }
}

Revolution::Nearest Revolution::nearestTo(const HalfPlaneVector& point) const {
    const auto distanceSqOf = [&](const Block& block) {
        const double radius =
            std::max(std::max(block.low.radius - point.radius, point.radius - block.high.radius), 0.0);
        const double height =
            std::max(std::max(block.low.height - point.height, point.height - block.high.height), 0.0);
        return radius * radius + height * height;
    };
    std::size_t first = 0;
    if (blocks_.size() > 1) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < blocks_.size(); ++k) {
            const double distanceSq = distanceSqOf(blocks_[k]);
            if (distanceSq < least) {
                least = distanceSq;
                first = k;
            }
        }
    }
    Nearest nearest{std::numeric_limits<double>::infinity(), &edges_.front(), 0.0};
    searchBlock(first, point, nearest);
    for (std::size_t k = 0; k < blocks_.size(); ++k)
        if (k != first && distanceSqOf(blocks_[k]) < nearest.distanceSq) searchBlock(k, point, nearest);
    return nearest;
}

// Beside an edge the distance is the component along its normal, without a square root, and changes its sign smoothly
// on the surface. At a corner it is the distance of the corner.
double Revolution::distanceInPlane(const HalfPlaneVector& point, HalfPlaneVector& gradient) const {
    const Nearest nearest = nearestTo(point);
    const Edge& edge = *nearest.edge;
    const HalfPlaneVector normal{edge.direction.height, -edge.direction.radius};
    const double radius = point.radius - edge.start.radius;
    const double height = point.height - edge.start.height;
    if (nearest.along > 0.0 && nearest.along < edge.length) {
        const double across = radius * normal.radius + height * normal.height;
        const double side = !isSolid_ && across < 0.0 ? -1.0 : 1.0;
        gradient = {side * normal.radius, side * normal.height};
        return side * across - halfThickness_;
    }
    const bool isAtStart = nearest.along <= 0.0;
    const HalfPlaneVector& mean = isAtStart ? edge.startNormal : edge.endNormal;
    const HalfPlaneVector away{radius - (isAtStart ? 0.0 : edge.length * edge.direction.radius),
                               height - (isAtStart ? 0.0 : edge.length * edge.direction.height)};
    const double distance = std::sqrt(away.radius * away.radius + away.height * away.height);
    if (distance > 0.0) {
        const double side = isSolid_ && away.radius * mean.radius + away.height * mean.height < 0.0 ? -1.0 : 1.0;
        gradient = {side * (away.radius / distance), side * (away.height / distance)};
        return side * distance - halfThickness_;
    }
    const double length = std::sqrt(mean.radius * mean.radius + mean.height * mean.height);
    gradient = length > 0.0 ? HalfPlaneVector{mean.radius / length, mean.height / length} : normal;
    return -halfThickness_;
}

SignedDistance Revolution::at(const Vec3& point) const {
    const double radius = std::sqrt(point.x() * point.x() + point.z() * point.z());
    HalfPlaneVector gradient;
    SignedDistance distance;
    distance.value = distanceInPlane({radius, point.y()}, gradient);
    const double x = radius > 0.0 ? point.x() / radius : 1.0;
    const double z = radius > 0.0 ? point.z() / radius : 0.0;
    distance.gradient = {gradient.radius * x, gradient.height, gradient.radius * z};
    return distance;
}

std::vector<ProfilePoint> cylinderProfile(double radius, double height) {
    return frustumProfile(radius, radius, height);
}

std::vector<ProfilePoint> frustumProfile(double bottomRadius, double topRadius, double height) {
    return {{0.0, -0.5 * height}, {bottomRadius, -0.5 * height}, {topRadius, 0.5 * height}, {0.0, 0.5 * height}};
}

std::vector<ProfilePoint> capsuleProfile(double radius, double height) {
    const double half = 0.5 * height - radius;
    return {{0.0, -half}, {0.0, half}};
}

}  // namespace engine
