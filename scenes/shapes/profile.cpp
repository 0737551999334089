#include "scenes/shapes/profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scenes {
namespace {

using engine::ProfilePoint;

/// Cosine of 3 degrees, the largest angle between neighboring edges of a curve. Chosen: a particle rolls over such a
/// corner with a thousandth of its speed across.
constexpr double kSmoothCosine = 0.9986295347545738;

/// Largest number of bisections of a stretch of a curve, which a cusp would need without end.
constexpr int kMostBisections = 7;

ProfilePoint operator+(const ProfilePoint& a, const ProfilePoint& b) {
    return {a.radius + b.radius, a.height + b.height};
}
ProfilePoint operator-(const ProfilePoint& a, const ProfilePoint& b) {
    return {a.radius - b.radius, a.height - b.height};
}
ProfilePoint operator*(double factor, const ProfilePoint& a) {
    return {factor * a.radius, factor * a.height};
}
double dotOf(const ProfilePoint& a, const ProfilePoint& b) {
    return a.radius * b.radius + a.height * b.height;
}
double crossOf(const ProfilePoint& a, const ProfilePoint& b) {
    return a.radius * b.height - a.height * b.radius;
}
double lengthOf(const ProfilePoint& a) {
    return std::sqrt(dotOf(a, a));
}
ProfilePoint mirrored(const ProfilePoint& a) {
    return {-a.radius, a.height};
}
bool isOnAxis(const ProfilePoint& point) {
    return point.radius == 0.0;
}

double sizeOf(const Profile& points) {
    double radius = 0.0;
    double low = points.front().height;
    double high = low;
    for (const ProfilePoint& point : points) {
        radius = std::max(radius, point.radius);
        low = std::min(low, point.height);
        high = std::max(high, point.height);
    }
    return std::max(2.0 * radius, high - low);
}

Profile withoutRepetitions(const ProfileSpec& spec) {
    const auto areEqual = [](const ProfilePoint& a, const ProfilePoint& b) {
        return a.radius == b.radius && a.height == b.height;
    };
    Profile points = spec.points;
    points.erase(std::unique(points.begin(), points.end(), areEqual), points.end());
    while (spec.isClosed && points.size() > 1 && areEqual(points.front(), points.back())) points.pop_back();
    return points;
}

/// The points before and after a point of a profile, as far as it is a corner. At the axis, one is a mirror image.
struct Corner {
    ProfilePoint before, at, after;
};

std::optional<Corner> cornerAt(const Profile& points, bool isClosed, std::size_t index) {
    const std::size_t count = points.size();
    const ProfilePoint& at = points[index];
    std::optional<ProfilePoint> before;
    std::optional<ProfilePoint> after;
    if (count > 1 && (isClosed || index > 0)) before = points[(index + count - 1) % count];
    if (count > 1 && (isClosed || index + 1 < count)) after = points[(index + 1) % count];
    if (isOnAxis(at)) {
        // An edge along the axis is no surface.
        if (before && isOnAxis(*before)) before.reset();
        if (after && isOnAxis(*after)) after.reset();
        if (before && !after) after = mirrored(*before);
        if (after && !before) before = mirrored(*after);
    }
    if (!before || !after) return std::nullopt;
    return Corner{*before, at, *after};
}

/// Appends the points of an arc between two directions from its center, which are unit vectors, without its ends.
void appendArc(Profile& points, const ProfilePoint& center, double radius,
               const std::pair<ProfilePoint, ProfilePoint>& ends, int bisections) {
    if (bisections == 0) return;
    const ProfilePoint sum = ends.first + ends.second;
    const ProfilePoint middle = (1.0 / lengthOf(sum)) * sum;
    appendArc(points, center, radius, {ends.first, middle}, bisections - 1);
    points.push_back(center + radius * middle);
    appendArc(points, center, radius, {middle, ends.second}, bisections - 1);
}

/// The corner rounded by an arc, from its first point to its last; the corner itself where it turns by 3 degrees or
/// less, or turns back.
Profile roundedCorner(const Corner& corner, double radius) {
    const ProfilePoint in = (1.0 / lengthOf(corner.at - corner.before)) * (corner.at - corner.before);
    const ProfilePoint out = (1.0 / lengthOf(corner.after - corner.at)) * (corner.after - corner.at);
    const double cosine = dotOf(in, out);
    const double sine = crossOf(in, out);
    if (cosine >= kSmoothCosine || cosine < -kSmoothCosine || radius <= 0.0) return {corner.at};
    // The arc touches the edges at this distance from the corner: the radius times the tangent of half the angle.
    const double halfTangent = std::abs(sine) / (1.0 + cosine);
    const double most = 0.5 * std::min(lengthOf(corner.at - corner.before), lengthOf(corner.after - corner.at));
    const double reach = std::min(radius * halfTangent, most);
    const double fitting = reach / halfTangent;
    const double side = sine > 0.0 ? 1.0 : -1.0;
    const ProfilePoint first{side * in.height, -side * in.radius};  // from the center to where the arc begins
    const ProfilePoint last{side * out.height, -side * out.radius};
    const ProfilePoint start = corner.at - reach * in;
    const ProfilePoint center = start - fitting * first;
    int bisections = 0;
    for (double bend = cosine; bend < kSmoothCosine; ++bisections) bend = std::sqrt(0.5 * (1.0 + bend));
    Profile points = {start};
    appendArc(points, center, fitting, {first, last}, bisections);
    points.push_back(corner.at + reach * out);
    return points;
}

/// Keeps the half of a rounded corner on the axis that belongs to the profile, and puts its middle on the axis.
void cutAtAxis(Profile& points, bool isFirstHalf) {
    if (points.size() < 2) return;
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    middle->radius = 0.0;
    if (isFirstHalf)
        points.erase(middle + 1, points.end());
    else
        points.erase(points.begin(), middle);
}

Profile withFillets(const ProfileSpec& spec, const Profile& points, double radius) {
    const bool isSolid = spec.isClosed && spec.thickness == 0.0;
    const double area = isSolid ? twiceArea(points) : 0.0;
    const double least = 1e-9 * sizeOf(points);  // between points: an edge by rounding alone leads anywhere
    Profile result;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto corner = cornerAt(points, spec.isClosed, k);
        const bool isInner =
            corner && (!isSolid || crossOf(corner->at - corner->before, corner->after - corner->at) * area < 0.0);
        if (!isInner) {
            result.push_back(points[k]);
            continue;
        }
        Profile rounded = roundedCorner(*corner, radius);
        const bool isAtAxis = isOnAxis(corner->at);
        if (isAtAxis && corner->after.radius < 0.0) cutAtAxis(rounded, true);
        if (isAtAxis && corner->before.radius < 0.0) cutAtAxis(rounded, false);
        const bool isAtLast = !result.empty() && lengthOf(rounded.front() - result.back()) <= least;
        result.insert(result.end(), rounded.begin() + (isAtLast ? 1 : 0), rounded.end());
    }
    if (spec.isClosed && result.size() > 1 && lengthOf(result.back() - result.front()) <= least) result.pop_back();
    return result;
}

/// A stretch of a curve as a cubic Bezier curve.
struct Stretch {
    ProfilePoint start, startControl, endControl, end;
};

bool isStraight(const Stretch& stretch) {
    const ProfilePoint chord = stretch.end - stretch.start;
    const double length = lengthOf(chord);
    for (const ProfilePoint& leg : {stretch.startControl - stretch.start, stretch.end - stretch.endControl}) {
        const double legLength = lengthOf(leg);
        // Half of 3 degrees on either side of the chord is 3 degrees between chords; its cosine is that.
        if (legLength > 0.0 && dotOf(leg, chord) < 0.9996573249755573 * legLength * length) return false;
    }
    return true;
}

/// Appends the points of a stretch without its start.
void appendStretch(Profile& points, const Stretch& stretch, int depth) {
    if (depth == 0 || isStraight(stretch)) {
        points.push_back({std::max(stretch.end.radius, 0.0), stretch.end.height});
        return;
    }
    const ProfilePoint a = 0.5 * (stretch.start + stretch.startControl);
    const ProfilePoint b = 0.5 * (stretch.startControl + stretch.endControl);
    const ProfilePoint c = 0.5 * (stretch.endControl + stretch.end);
    const ProfilePoint ab = 0.5 * (a + b);
    const ProfilePoint bc = 0.5 * (b + c);
    const ProfilePoint middle = 0.5 * (ab + bc);
    appendStretch(points, {stretch.start, a, ab, middle}, depth - 1);
    appendStretch(points, {middle, bc, c, stretch.end}, depth - 1);
}

/// The stretch between the two middle ones of four points of a centripetal Catmull-Rom curve, whose knots are as far
/// apart as the square roots of the distances: it has no loops, and overshoots little (Yuksel and others, 2011).
Stretch centripetalStretch(const ProfilePoint& before, const ProfilePoint& start, const ProfilePoint& end,
                           const ProfilePoint& after) {
    const auto knotDistance = [](const ProfilePoint& a, const ProfilePoint& b) { return std::sqrt(lengthOf(b - a)); };
    const double d1 = knotDistance(before, start);
    const double d2 = knotDistance(start, end);
    const double d3 = knotDistance(end, after);
    const auto slope = [](const ProfilePoint& a, const ProfilePoint& b, double step) { return (1.0 / step) * (b - a); };
    const ProfilePoint middle = slope(start, end, d2);
    ProfilePoint startSlope = middle;
    ProfilePoint endSlope = middle;
    if (d1 > 0.0) startSlope = startSlope + slope(before, start, d1) - (1.0 / (d1 + d2)) * (end - before);
    if (d3 > 0.0) endSlope = endSlope + slope(end, after, d3) - (1.0 / (d2 + d3)) * (after - start);
    return {start, start + (d2 / 3.0) * startSlope, end - (d2 / 3.0) * endSlope, end};
}

/// The point that a curve comes from or goes to beyond an end: the mirror image at the axis, where the curve is level,
/// otherwise nothing, which is the end itself.
ProfilePoint beyond(const ProfilePoint& end, const ProfilePoint& neighbor) {
    return isOnAxis(end) ? mirrored(neighbor) : end;
}

Profile smoothCurve(const Profile& points, bool isClosed) {
    const std::size_t count = points.size();
    if (count < 3) return points;
    const auto isAxisEdge = [&](std::size_t k) {
        return isOnAxis(points[k % count]) && isOnAxis(points[(k + 1) % count]);
    };
    Profile result = {points[0]};
    for (std::size_t k = 0; k < (isClosed ? count : count - 1); ++k) {
        const ProfilePoint& start = points[k];
        const ProfilePoint& end = points[(k + 1) % count];
        if (isAxisEdge(k)) {
            result.push_back(end);
            continue;
        }
        const std::size_t previous = (k + count - 1) % count;
        const bool begins = (!isClosed && k == 0) || isAxisEdge(previous);
        const bool ends = (!isClosed && k + 2 == count) || isAxisEdge(k + 1);
        const ProfilePoint before = begins ? beyond(start, end) : points[previous];
        const ProfilePoint after = ends ? beyond(end, start) : points[(k + 2) % count];
        appendStretch(result, centripetalStretch(before, start, end, after), kMostBisections);
    }
    if (isClosed) result.pop_back();
    return result;
}

bool doCross(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c, const ProfilePoint& d) {
    const auto sideOf = [](const ProfilePoint& from, const ProfilePoint& to, const ProfilePoint& point) {
        return crossOf(to - from, point - from);
    };
    return sideOf(a, b, c) * sideOf(a, b, d) < 0.0 && sideOf(c, d, a) * sideOf(c, d, b) < 0.0;
}

/// Where a closed profile crosses itself: the indices of two edges.
std::optional<std::pair<std::size_t, std::size_t>> crossingOf(const Profile& points) {
    const std::size_t count = points.size();
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t other = k + 2; other < count; ++other)
            if (doCross(points[k], points[(k + 1) % count], points[other], points[(other + 1) % count]))
                return std::pair{k, other};
    return std::nullopt;
}

}  // namespace

double twiceArea(const Profile& points) {
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        sum += crossOf(points[k] - points[0], points[(k + 1) % points.size()] - points[0]);
    return sum;
}

std::string profileProblem(const ProfileSpec& spec) {
    const Profile points = withoutRepetitions(spec);
    const bool isSolid = spec.isClosed && spec.thickness == 0.0;
    if (!isSolid && spec.thickness == 0.0) return "is open and needs a thickness, or closed = true";
    if (!isSolid) return "";
    if (points.size() < 3) return "has fewer than three different points, which enclose nothing; give it a thickness";
    if (const auto crossing = crossingOf(points))
        return "crosses itself: the edge after point " + std::to_string(crossing->first + 1) + " and the one after " +
               std::to_string(crossing->second + 1);
    const double size = sizeOf(points);
    if (std::abs(twiceArea(points)) <= 1e-9 * size * size) return "encloses no area; give it a thickness";
    if (spec.isSmooth && crossingOf(refinedProfile(spec)))
        return "crosses itself where its curve is drawn; give it more points, or leave out smooth";
    return "";
}

Profile refinedProfile(const ProfileSpec& spec) {
    const Profile points = withoutRepetitions(spec);
    if (spec.isSmooth) return smoothCurve(points, spec.isClosed);
    const double radius = spec.fillet >= 0.0     ? spec.fillet
                          : spec.thickness > 0.0 ? spec.thickness
                                                 : sizeOf(points) / 50.0;
    return withFillets(spec, points, radius);
}

engine::Revolution revolutionOf(const ProfileSpec& spec) {
    return {refinedProfile(spec), spec.isClosed, 0.5 * spec.thickness};
}

}  // namespace scenes
