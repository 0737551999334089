// Sites of nozzles: as many as fit, where they belong, and in an order that makes an even jet.
#include "engine/state/emitter_sites.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include "tests/catch.h"

using namespace engine;

namespace {

/// The smallest distance between two points, m.
double leastDistance(const std::vector<Vec3>& points) {
    double least = 1e300;
    for (std::size_t a = 0; a < points.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) least = std::min(least, (points[a] - points[b]).norm());
    return least;
}

Vec3 meanOf(const std::vector<Vec3>& points) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& point : points) mean += point / static_cast<double>(points.size());
    return mean;
}

bool isLess(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// How strongly sites that emit in their order lie on slanted layers: the largest power, over wave vectors across the
/// jet of this length, of a wave whose period along the jet is one interval. 1 on average for a random order.
double layering(const std::vector<Vec3>& sites, double wavelength) {
    double most = 0.0;
    for (int turn = 0; turn < 24; ++turn) {
        const double angle = 2.0 * std::numbers::pi * turn / 24.0;
        const Vec3 wave = 2.0 * std::numbers::pi / wavelength * Vec3(std::cos(angle), 0.0, std::sin(angle));
        std::complex<double> sum = 0.0;
        for (std::size_t k = 0; k < sites.size(); ++k)
            sum += std::polar(1.0, dot(wave, sites[k]) + 2.0 * std::numbers::pi * static_cast<double>(k) /
                                                             static_cast<double>(sites.size()));
        most = std::max(most, std::norm(sum) / static_cast<double>(sites.size()));
    }
    return most;
}

}  // namespace

TEST_CASE("A disc nozzle is hexagonal and lies across its direction", "[emitters]") {
    CHECK(discSites(Vec3::Zero(), Vec3::UnitY(), 0.0, 0.3).size() == 1);
    CHECK(discSites(Vec3::Zero(), Vec3::UnitY(), 0.3, 0.3).size() == 7);
    CHECK(discSites(Vec3::Zero(), Vec3::UnitY(), 0.6, 0.3).size() == 19);
    const Vec3 direction(1, 2, -0.5);
    for (const Vec3& site : discSites(Vec3(1, 1, 1), direction, 0.6, 0.3)) {
        CHECK(std::abs(dot(site - Vec3(1, 1, 1), direction)) < 1e-14);  // rounding of products of size 2
        CHECK((site - Vec3(1, 1, 1)).norm() <= 0.6 + 1e-8);             // the slack of the rim
    }
}

TEST_CASE("A ring nozzle has as many evenly spaced sites as fit", "[emitters]") {
    const Vec3 direction(0, 3, 4);
    for (const double radius : {0.01, 0.3, 0.31, 2.0}) {
        const std::vector<Vec3> sites = ringSites(Vec3(1, 1, 1), direction, radius, 0.3);
        INFO(radius);
        // n chords of 0.3 m span the circle if 2 R sin(pi / n) is at least 0.3.
        const double n = radius < 0.15 ? 1.0 : std::floor(std::numbers::pi / std::asin(0.15 / radius) + 1e-6);
        CHECK(static_cast<double>(sites.size()) == n);
        if (sites.size() > 1) CHECK((meanOf(sites) - Vec3(1, 1, 1)).norm() < 1e-13);  // rounding of 40 turns
        for (std::size_t k = 0; k < sites.size(); ++k) {
            CHECK((sites[k] - Vec3(1, 1, 1)).norm() == Approx(radius).epsilon(1e-13));
            CHECK(std::abs(dot(sites[k] - Vec3(1, 1, 1), direction)) < 1e-13);
            if (sites.size() > 1)
                CHECK((sites[k] - sites[(k + 1) % sites.size()]).norm() ==
                      Approx(2.0 * radius * std::sin(std::numbers::pi / n)).epsilon(1e-12));
        }
    }
}

TEST_CASE("A line nozzle reaches from end to end", "[emitters]") {
    const std::vector<Vec3> sites = lineSites(Vec3(1, 0, 0), Vec3(2, 0, 0), 0.3);
    REQUIRE(sites.size() == 4);
    CHECK(sites.front() == Vec3(1, 0, 0));
    CHECK(sites.back() == Vec3(2, 0, 0));
    CHECK(leastDistance(sites) == Approx(1.0 / 3.0));
    CHECK(lineSites(Vec3(1, 0, 0), Vec3(1.9, 0, 0), 0.3).size() == 4);  // 0.9 is three times 0.3 but for rounding
    CHECK(lineSites(Vec3(1, 0, 0), Vec3(1.2, 0, 0), 0.3) == std::vector<Vec3>{Vec3(1.1, 0, 0)});
}

TEST_CASE("A box nozzle is filled in as many dimensions as it has", "[emitters]") {
    const Vec3 center(1, 2, 3);
    const auto filled = [&](const Vec3& size) {
        const std::vector<Vec3> sites = boxSites(center, size, 0.3);
        INFO(size.transpose());
        if (sites.size() > 1) CHECK(leastDistance(sites) >= 0.3 - 1e-12);
        for (const Vec3& site : sites)
            for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(site[axis] - center[axis]) <= 0.5 * size[axis] + 1e-8);
        CHECK((meanOf(sites) - center).cwiseAbs().maxCoeff() < 0.15);
        return sites.size();
    };
    CHECK(filled(Vec3(0, 0, 0)) == 1);
    CHECK(filled(Vec3(0, 3, 0)) == 11);
    CHECK(filled(Vec3(0.9, 0, 0.9)) == 14);  // four rows of 4 and 3
    CHECK(filled(Vec3(0.9, 0, 0.1)) == 4);
    CHECK(filled(Vec3(0.1, 0, 0.1)) == 1);
    // Hexagonal: an area of 0.866 spacings squared for each site, cubic close: 0.707 spacings cubed; the rim aside.
    CHECK(static_cast<double>(filled(Vec3(9, 9, 0))) == Approx(81.0 / (0.09 * std::sqrt(0.75))).epsilon(0.05));
    CHECK(static_cast<double>(filled(Vec3(6, 6, 6))) == Approx(216.0 / (0.027 * std::sqrt(0.5))).epsilon(0.15));
}

TEST_CASE("Sites take turns: all of them, anywhere in the nozzle, without slanted layers", "[emitters]") {
    for (const double radius : {0.54, 0.78, 1.2, 1.5}) {
        const std::vector<Vec3> sites = discSites(Vec3::Zero(), Vec3::UnitY(), radius, 0.3);
        std::vector<Vec3> order = takingTurns(sites);
        INFO(sites.size() << " sites");
        // A random order has 1 on average in each direction, and 3 in the worst.
        CHECK(layering(order, 2.2 * radius) < 1.0);
        CHECK(layering(order, 4.0 * radius) < 1.0);
        CHECK(layering(sites, 2.2 * radius) > 4.0);  // row by row they are slanted layers
        std::vector<Vec3> same = sites;
        std::sort(same.begin(), same.end(), isLess);
        std::sort(order.begin(), order.end(), isLess);
        CHECK(order == same);
    }
    CHECK(takingTurns({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}).size() == 3);
    const std::vector<Vec3> many = discSites(Vec3::Zero(), Vec3::UnitY(), 6.0, 0.3);  // too many to be evened
    CHECK(takingTurns(many).size() == many.size());
}

TEST_CASE("A cluster is a round close packing", "[emitters]") {
    CHECK(clusterPositions(1, 0.3) == std::vector<Vec3>{Vec3::Zero()});
    for (const std::size_t count : {2U, 5U, 13U, 50U, 1000U}) {
        const std::vector<Vec3> cluster = clusterPositions(count, 0.3);
        INFO(count);
        REQUIRE(cluster.size() == count);
        CHECK(meanOf(cluster).norm() < 1e-12);
        CHECK(leastDistance(cluster) == Approx(0.3));
        double outermost = 0.0;
        for (const Vec3& point : cluster) outermost = std::max(outermost, point.norm());
        // A ball of the same volume, and a spacing more.
        const double ball = std::cbrt(0.75 / std::numbers::pi * static_cast<double>(count) * std::sqrt(0.5)) * 0.3;
        CHECK(outermost < ball + 0.3);
    }
}

TEST_CASE("1 - cos(a) is exact to rounding", "[emitters]") {
    for (double degrees = 0.0; degrees <= 180.0; degrees += 7.5) {
        const double half = std::sin(degrees * std::numbers::pi / 360.0);
        CHECK(oneMinusCosine(degrees) == Approx(2.0 * half * half).epsilon(1e-14).margin(1e-300));
    }
}
