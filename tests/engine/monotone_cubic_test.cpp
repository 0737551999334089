// Tests the paths of cameras and obstacles: smooth, monotone from key to key, at rest outside.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/monotone_cubic.h"
#include "engine/core/random.h"
#include "tests/engine/rounding.h"

namespace {

struct PathKey {
    double time = 0.0;
    std::array<double, 2> values{};
};

using Path = std::vector<PathKey>;

engine::PathPoint<2> at(const Path& path, double time) {
    return engine::pathAt<2>(
        path.size(), time, [&](std::size_t key) { return path[key].time; },
        [&](std::size_t key) { return path[key].values; });
}

/// A path of eight keys at uneven times, of which some neighbors are equal.
Path randomPath(std::uint64_t seed) {
    Path path;
    double time = -1.0;
    for (std::uint64_t key = 0; key < 8; ++key) {
        const engine::Vec3 random = engine::randomVector(seed, key);
        time += 0.01 + std::abs(random.z());
        path.push_back({time, {random.x(), key % 3 == 2 ? path.back().values[1] : 100.0 * random.y()}});
    }
    return path;
}

}  // namespace

TEST_CASE("a path of one key stays there") {
    const Path path = {{2.0, {3.0, -4.0}}};
    for (const double time : {-1e9, 1.9, 2.0, 2.1, 1e9}) {
        CHECK(at(path, time).values == path[0].values);
        CHECK(at(path, time).slopes == std::array{0.0, 0.0});
    }
}

TEST_CASE("before the first and after the last key a path is at rest") {
    const Path path = {{1.0, {0.0, 5.0}}, {2.0, {1.0, 6.0}}, {4.0, {3.0, 2.0}}};
    for (const double time : {-1e9, 0.0, 1.0}) CHECK(at(path, time).values == path[0].values);
    for (const double time : {4.0, 4.5, 1e9}) CHECK(at(path, time).values == path[2].values);
    for (const double time : {-1.0, 1.0, 4.0, 5.0}) CHECK(at(path, time).slopes == std::array{0.0, 0.0});
}

TEST_CASE("a path has the values of its keys at their times, to the last bit") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Path path = randomPath(seed);
        for (const PathKey& key : path) CHECK(at(path, key.time).values == key.values);
    }
}

TEST_CASE("a path of two keys is the cubic that rests at both") {
    const Path path = {{1.0, {2.0, 0.0}}, {5.0, {10.0, 0.0}}};
    for (double u = 0.0; u <= 1.0; u += 0.0625) {
        const engine::PathPoint<2> point = at(path, 1.0 + 4.0 * u);
        // From 2 by 8 within 4 s; two roundings each of values up to 10 and of slopes up to 3.
        CHECK(point.values[0] == Approx(2.0 + 8.0 * (3.0 * u * u - 2.0 * u * u * u)).margin(20.0 * kEps));
        CHECK(point.slopes[0] == Approx(8.0 / 4.0 * 6.0 * (u - u * u)).margin(6.0 * kEps));
    }
}

TEST_CASE("at a key within a path the slope is the weighted harmonic mean of those beside it") {
    const Path path = {{0.0, {0.0, 0.0}}, {1.0, {1.0, 1.0}}, {3.0, {9.0, 0.0}}};
    // Slopes 1 and 4 over 1 s and 2 s: weights 1 + 2 * 2 and 2 + 2 * 1, and (5 + 4) / (5 / 1 + 4 / 4) = 1.5.
    CHECK(at(path, 1.0).slopes[0] == Approx(1.5).epsilon(4.0 * kEps));
    CHECK(at(path, 1.0).slopes[1] == 0.0);  // an extremum
}

TEST_CASE("no value leaves the interval between its keys, or turns back within it") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Path path = randomPath(seed);
        for (std::size_t next = 1; next < path.size(); ++next)
            for (std::size_t k = 0; k < 2; ++k) {
                const double from = path[next - 1].values[k];
                const double to = path[next].values[k];
                // Roundings of a sum of three terms, each at most as large as the values beside it.
                const double margin = 8.0 * kEps * std::max(std::abs(from), std::abs(to));
                double before = from;
                for (double u = 0.015625; u <= 1.0; u += 0.015625) {
                    const double now =
                        at(path, path[next - 1].time + u * (path[next].time - path[next - 1].time)).values[k];
                    CHECK((to >= from ? now >= before - margin : now <= before + margin));
                    CHECK((now >= std::min(from, to) - margin && now <= std::max(from, to) + margin));
                    before = now;
                }
            }
    }
}

TEST_CASE("a number that is the same at two keys keeps its bits between them") {
    const Path path = {{0.0, {0.1, 7.0}}, {1.0, {0.3, 8.0}}, {2.0, {0.3, 9.0}}, {3.0, {0.7, 9.5}}};
    for (double time = 1.0; time <= 2.0; time += 0.03125) {
        CHECK(at(path, time).values[0] == 0.3);
        CHECK(at(path, time).slopes[0] == 0.0);
    }
}

TEST_CASE("the slopes of a path are the derivatives of its values, and continuous") {
    constexpr double kShort = 1e-5;  // s
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Path path = randomPath(seed);
        for (std::size_t next = 1; next < path.size(); ++next) {
            const double length = path[next].time - path[next - 1].time;
            for (const double u : {0.25, 0.5, 0.75}) {
                const double time = path[next - 1].time + u * length;
                const auto [values, slopes] = at(path, time);
                for (std::size_t k = 0; k < 2; ++k) {
                    const double difference =
                        (at(path, time + kShort).values[k] - at(path, time - kShort).values[k]) / (2.0 * kShort);
                    const double rise = std::abs(path[next].values[k] - path[next - 1].values[k]);
                    // The third derivative of a monotone cubic is at most 6 (2 + 3 + 3) rise / length^3; values of up
                    // to 100 have roundings of 100 kEps.
                    const double tolerance =
                        kShort * kShort / 6.0 * 48.0 * rise / (length * length * length) + 8.0 * 100.0 * kEps / kShort;
                    CHECK(slopes[k] == Approx(difference).margin(tolerance).epsilon(0.0));
                }
            }
            // Across a key the slope changes by the second derivative, at most (6 + 4 * 3 + 2 * 3) rise / length^2,
            // times the distance.
            for (std::size_t k = 0; k < 2; ++k) {
                const double rise = std::abs(path[next].values[k] - path[next - 1].values[k]);
                const double tolerance = 1e-9 * 24.0 * rise / (length * length) + 64.0 * kEps * 100.0 / length;
                CHECK(at(path, path[next].time - 1e-9).slopes[k] ==
                      Approx(at(path, path[next].time).slopes[k]).margin(tolerance).epsilon(0.0));
            }
        }
    }
}

TEST_CASE("slopes so small that their product underflows still count as a rise") {
    const Path path = {{0.0, {0.0, 0.0}}, {1.0, {1e-200, 0.0}}, {2.0, {2e-200, 0.0}}};
    CHECK(at(path, 1.0).slopes[0] == Approx(1e-200).epsilon(4.0 * kEps));
}
