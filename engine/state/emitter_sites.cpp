// Sites of nozzles. Sines are summed here, because the last bit of the library's may differ from machine to machine.
#include "engine/state/emitter_sites.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/core/exp_negative.h"
#include "engine/state/bodies.h"

namespace engine {
namespace {

/// Relative tolerance with which sites exactly on the rim of a nozzle count as inside.
constexpr double kRimSlack = 1.0 + 1e-9;

/// Sine of an angle from 0 to pi / 2. Taylor to x^23/23!: the first term left out is below 1.6^25/25! = 9e-21.
double sine(double angle) {
    double sum = 1.0;
    for (int order = 22; order >= 2; order -= 2) sum = 1.0 - sum * angle * angle / (order * (order + 1));
    return angle * sum;
}

/// The axis along which points extend furthest.
int longestAxis(const std::vector<Vec3>& points) {
    Vec3 low = points.front();
    Vec3 high = points.front();
    for (const Vec3& point : points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    return axis;
}

/// Rows of a hexagonal packing in a rectangle of two edges (m) around a center, the rows along `first`.
std::vector<Vec3> rowSites(const Vec3& center, const Vec3& first, const Vec3& second, double spacing) {
    const double width = std::sqrt(squaredLength(first));
    const double height = std::sqrt(squaredLength(second));
    if (2.0 * width * kRimSlack < spacing) return lineSites(center - 0.5 * second, center + 0.5 * second, spacing);
    const double rowHeight = spacing * std::sqrt(0.75);
    const double rows = std::floor(height * kRimSlack / rowHeight) + 1.0;
    const double fullRow = std::floor(width * kRimSlack / spacing);
    const double shifted = std::floor(width * kRimSlack / spacing - 0.5) + 0.5;
    const double reach = rows > 1.0 ? std::max(fullRow, shifted) : fullRow;  // of the longest row, in spacings
    std::vector<Vec3> sites;
    for (double row = 0.0; row < rows; row += 1.0) {
        const bool isShifted = std::fmod(row, 2.0) != 0.0;
        const double across2 = (row - 0.5 * (rows - 1.0)) * rowHeight;
        for (double column = isShifted ? 0.5 : 0.0; column <= (isShifted ? shifted : fullRow); column += 1.0) {
            const double across1 = (column - 0.5 * reach) * spacing;
            sites.push_back(center + across1 / width * first + across2 / std::max(height, rowHeight) * second);
        }
    }
    return sites;
}

/// Sites in an order in which the halves of the nozzle take turns, and so do the halves of each half.
std::vector<Vec3> alternatingHalves(std::vector<Vec3> sites) {
    if (sites.size() < 2) return sites;
    const int axis = longestAxis(sites);
    std::stable_sort(sites.begin(), sites.end(), [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    const auto middle = sites.begin() + static_cast<std::ptrdiff_t>((sites.size() + 1) / 2);
    const std::vector<Vec3> low = alternatingHalves({sites.begin(), middle});
    const std::vector<Vec3> high = alternatingHalves({middle, sites.end()});
    std::vector<Vec3> order;
    for (std::size_t k = 0; k < low.size(); ++k) {
        order.push_back(low[k]);
        if (k < high.size()) order.push_back(high[k]);
    }
    return order;
}

/// Smallest squared distance of two sites that are not the same point; 1 if there are none.
double leastSquaredDistance(const std::vector<Vec3>& sites) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sites.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (const double distanceSq = squaredLength(sites[i] - sites[j]); distanceSq > 0.0)
                least = std::min(least, distanceSq);
    return std::isfinite(least) ? least : 1.0;
}

/// How close the emissions of two sites are in a jet whose layers are as far apart as the sites: the Gaussian of their
/// distance, in spacings, as the product of a factor across the jet and one along it.
class Closeness {
 public:
    explicit Closeness(const std::vector<Vec3>& sites) : count_(sites.size()) {
        constexpr double kWidth = 0.6;  // chosen: of 0.4, 0.6 and 0.9 the one with the weakest helical layers
        constexpr double kFactor = 0.5 / (kWidth * kWidth);
        const double spacingSq = leastSquaredDistance(sites);
        for (const Vec3& a : sites)
            for (const Vec3& b : sites) across_.push_back(expNegative(kFactor * squaredLength(a - b) / spacingSq));
        for (std::size_t k = 0; k < count_; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(count_);
            double sum = 0.0;
            for (double layer = -3.0; layer <= 3.0; layer += 1.0)
                sum += expNegative(kFactor * (share + layer) * (share + layer));
            along_.push_back(sum);
        }
    }

    /// Sum over the others of what changes if the sites at two places of the order are exchanged.
    double gainOfExchange(const std::vector<std::size_t>& order, std::size_t a, std::size_t b) const {
        double gain = 0.0;
        for (std::size_t k = 0; k < count_; ++k) {
            if (k == a || k == b) continue;
            const double* const row = &across_[count_ * order[k]];
            gain += (row[order[a]] - row[order[b]]) *
                    (along_[(a + count_ - k) % count_] - along_[(b + count_ - k) % count_]);
        }
        return gain;
    }

 private:
    std::size_t count_ = 0;
    std::vector<double> across_;  ///< by the indices of two sites
    std::vector<double> along_;   ///< by the number of places between two sites in the order
};

/// The most sites whose order is evened. Chosen: it takes a tenth of a second; a wider jet has no visible layers.
constexpr std::size_t kMostEvened = 128;

/// Exchanges sites of an order for as long as that moves those that emit shortly after each other apart.
void even(std::vector<Vec3>& sites) {
    constexpr int kMostRounds = 8;
    constexpr double kLeastGain = 1e-9;  // far above rounding errors
    const Closeness closeness(sites);
    std::vector<std::size_t> order(sites.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    bool hasChanged = true;
    for (int round = 0; hasChanged && round < kMostRounds; ++round) {
        hasChanged = false;
        for (std::size_t a = 1; a < order.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (closeness.gainOfExchange(order, a, b) > kLeastGain) {
                    std::swap(order[a], order[b]);
                    hasChanged = true;
                }
    }
    const std::vector<Vec3> before = sites;
    for (std::size_t k = 0; k < order.size(); ++k) sites[k] = before[order[k]];
}

}  // namespace

PlaneAxes axesAcross(const Vec3& direction) {
    const double length = std::sqrt(squaredLength(direction));
    if (length == 0.0) return {};
    const Vec3 unit = direction / length;
    // A coordinate axis that is far from parallel to the direction, so that the cross product is not small.
    const Vec3 axis = std::abs(unit.z()) < 0.7 ? Vec3::UnitZ() : Vec3::UnitX();
    Vec3 first = axis.cross(unit);
    first /= std::sqrt(squaredLength(first));
    return {first, unit.cross(first)};
}

std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing) {
    const PlaneAxes plane = axesAcross(direction);
    const double rowHeight = spacing * std::sqrt(0.75);
    const auto rows = static_cast<int>(std::floor(radius * kRimSlack / rowHeight));
    std::vector<Vec3> sites;
    for (int row = -rows; row <= rows; ++row) {
        const double across2 = row * rowHeight;
        const double shift = row % 2 == 0 ? 0.0 : 0.5 * spacing;
        const auto columns = static_cast<int>(std::floor(radius * kRimSlack / spacing)) + 1;
        for (int column = -columns; column <= columns; ++column) {
            const double across1 = column * spacing + shift;
            if (across1 * across1 + across2 * across2 > radius * radius * kRimSlack) continue;
            sites.push_back(center + across1 * plane.first + across2 * plane.second);
        }
    }
    return sites;
}

std::vector<Vec3> ringSites(const Vec3& center, const Vec3& direction, double radius, double spacing) {
    const PlaneAxes plane = axesAcross(direction);
    const auto chord = [&](double count) { return 2.0 * radius * sine(std::numbers::pi / count); };
    double count = std::floor(2.0 * std::numbers::pi * radius / spacing);  // the arcs are longer than the chords
    while (count > 1.0 && chord(count) * kRimSlack < spacing) count -= 1.0;
    count = std::max(1.0, count);
    // A point is the one before turned by 2 pi / count: cos 2a = 1 - 2 sin^2 a, sin 2a = 2 sin a cos a.
    const double half = count > 1.0 ? sine(std::numbers::pi / count) : 0.0;
    const double cosine = 1.0 - 2.0 * half * half;
    const double turn = 2.0 * half * std::sqrt(std::max(0.0, 1.0 - half * half));
    std::vector<Vec3> sites;
    double x = radius;
    double y = 0.0;
    for (double k = 0.0; k < count; k += 1.0) {
        sites.push_back(center + x * plane.first + y * plane.second);
        const double next = cosine * x - turn * y;
        y = turn * x + cosine * y;
        x = next;
    }
    return sites;
}

std::vector<Vec3> lineSites(const Vec3& from, const Vec3& to, double spacing) {
    const Vec3 along = to - from;
    const double gaps = std::floor(std::sqrt(squaredLength(along)) * kRimSlack / spacing);
    if (gaps < 1.0) return {from + 0.5 * along};
    std::vector<Vec3> sites;
    for (double k = 0.0; k <= gaps; k += 1.0) sites.push_back(from + k / gaps * along);
    return sites;
}

std::vector<Vec3> boxSites(const Vec3& center, const Vec3& size, double spacing) {
    std::vector<Vec3> edges;
    for (int axis = 0; axis < 3; ++axis)
        if (size[axis] > 0.0) edges.push_back(size[axis] * Vec3::Unit(axis));
    std::stable_sort(edges.begin(), edges.end(), [](const Vec3& a, const Vec3& b) { return a.sum() > b.sum(); });
    if (edges.empty()) return {center};
    if (edges.size() == 1) return lineSites(center - 0.5 * edges[0], center + 0.5 * edges[0], spacing);
    if (edges.size() == 2) return rowSites(center, edges[0], edges[1], spacing);
    return boxPositions(center - 0.5 * size, center + 0.5 * size, {.spacing = spacing});
}

std::vector<Vec3> takingTurns(const std::vector<Vec3>& sites) {
    std::vector<Vec3> order = alternatingHalves(sites);
    if (order.size() > 2 && order.size() <= kMostEvened) even(order);
    return order;
}

std::vector<Vec3> clusterPositions(std::size_t count, double spacing) {
    if (count < 2) return {Vec3::Zero()};
    // No two points of the lattice are equally far from this point, so that the order does not depend on rounding. A
    // ball of radius m in half edges has 2 m^3 points and more.
    const Vec3 middle(0.31, 0.17, 0.43);
    int reach = 2;
    while (static_cast<std::size_t>((reach - 1) * (reach - 1) * (reach - 1)) < count) ++reach;
    std::vector<Vec3> points;
    for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                if ((x + y + z) % 2 == 0) points.emplace_back(x, y, z);
    std::stable_sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
        return squaredLength(a - middle) < squaredLength(b - middle);
    });
    points.resize(count);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& point : points) mean += point / static_cast<double>(count);
    for (Vec3& point : points) point = spacing / std::sqrt(2.0) * (point - mean);
    return points;
}

double oneMinusCosine(double degrees) {
    const double half = sine(0.5 * degrees * std::numbers::pi / 180.0);
    return 2.0 * half * half;
}

}  // namespace engine
