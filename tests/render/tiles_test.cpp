// Binning: every sphere that a pixel's ray meets is on the list of its tile, in the right order.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/prepare/cells/tiles.h"
#include "tests/render/pictures.h"

TEST_CASE("indicesByKey sorts by key and keeps the order of equal keys") {
    const std::vector<float> keys = {3.0F, -1.0F, 0.0F, -0.5F, 3.0F, -1e30F, 1e-30F};
    CHECK(render::indicesByKey(keys) == std::vector<std::uint32_t>{5, 1, 3, 2, 6, 0, 4});
    CHECK(render::indicesByKey({}).empty());
}

TEST_CASE("Every sphere that a pixel's ray meets is on its tile's list, front to back") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        render::View view = pictures::cloud(300);
        view.camera.projection = projection;
        view.camera.halfHeight = 1.5F;
        view.camera.eye = {0.2F, 1.0F, 1.2F};  // amid the particles: some are behind the eye, some contain it
        const render::PictureSize size{90, 50};
        const render::CameraFrame frame = render::cameraFrame(view.camera, size);
        std::vector<render::ViewSphere> spheres;
        for (const render::Sphere& s : view.particles) spheres.push_back({frame.toView(s.center), s.radius});
        const render::CellLists lists = render::binToTiles(frame, spheres, render::pixelBounds(frame, spheres));
        REQUIRE(lists.columns == 6);
        REQUIRE(lists.rows == 4);
        int met = 0;
        int missing = 0;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const oracle::Ray ray = oracle::pixelRay(view, size, x + 0.5, y + 0.5);
                const std::size_t cell = lists.cellIndex(x / 16, y / 16);
                const auto begin = lists.items.begin() + lists.begin[cell];
                const auto end = lists.items.begin() + lists.begin[cell + 1];
                for (std::uint32_t k = 0; k < view.particles.size(); ++k) {
                    const glm::dvec3 toCenter = glm::dvec3(view.particles[k].center) - ray.origin;
                    const double along = glm::dot(toCenter, ray.direction);
                    const double radius = view.particles[k].radius;
                    const double square = glm::dot(toCenter, toCenter) - along * along;
                    if (square > radius * radius || along + std::sqrt(radius * radius - square) < 0.0) continue;
                    ++met;
                    missing += std::find(begin, end, k) == end ? 1 : 0;
                }
            }
        }
        CHECK(met > 1000);
        CHECK(missing == 0);
        for (std::size_t cell = 0; cell + 1 < lists.begin.size(); ++cell) {
            const auto front = [&](std::uint32_t k) { return spheres[k].center.z - spheres[k].radius; };
            CHECK(std::is_sorted(lists.items.begin() + lists.begin[cell], lists.items.begin() + lists.begin[cell + 1],
                                 [&](std::uint32_t a, std::uint32_t b) { return front(a) < front(b); }));
        }
    }
}

namespace {

/// The extent of a sphere's projection along one axis, in pixels from the center of the picture.
std::pair<double, double> projected(double center, double depth, double radius, bool perspective, double perUnit) {
    if (!perspective) return {(center - radius) * perUnit, (center + radius) * perUnit};
    // Angles at the eye: to the center of the sphere, and from there to its outline.
    const double middle = std::atan2(center, depth);
    const double half = std::asin(radius / std::hypot(center, depth));
    return {std::tan(middle - half) * perUnit, std::tan(middle + half) * perUnit};
}

}  // namespace

TEST_CASE("The pixels that spheres may touch are their projection and a margin of one") {
    struct Lens {
        render::Projection projection;
        float degrees;
        render::PictureSize size;
    };
    std::mt19937 random(11);
    const auto between = [&](double low, double high) {
        return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
    };
    for (const Lens& lens : {Lens{render::Projection::perspective, 40.0F, {1280, 720}},
                             Lens{render::Projection::perspective, 1.0F, {8192, 8192}},
                             Lens{render::Projection::perspective, 150.0F, {640, 480}},
                             Lens{render::Projection::orthographic, 40.0F, {1280, 720}}}) {
        CAPTURE(lens.degrees);
        render::Camera camera;
        camera.projection = lens.projection;
        camera.verticalFov = glm::radians(lens.degrees);
        const render::CameraFrame frame = render::cameraFrame(camera, lens.size);
        const bool perspective = frame.perspective;
        std::vector<render::ViewSphere> spheres;
        for (int k = 0; k < 2003; ++k) {
            const float radius = between(0.001, 1.0);
            const float z = between(-1.0, 9.0);
            const float reach = perspective ? 1.3F * std::abs(z) : 1.3F;
            spheres.push_back(
                {{between(-1.0, 1.0) * reach * frame.halfWidth, between(-1.0, 1.0) * reach * frame.halfHeight, z},
                 radius});
            if (k % 5 > 1) continue;
            // Just in front of the eye's plane, entirely or touching it.
            spheres.back().center.z = radius * between(1.0002, 1.1);
            if (k % 5 == 1) spheres.back().center.x = radius * between(0.98, 1.02);
        }
        const std::vector<render::Rect> touched = render::pixelBounds(frame, spheres);
        REQUIRE(touched.size() == spheres.size());
        int visible = 0;
        int hidden = 0;
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            const auto [center, radius] = spheres[k];
            const render::Rect& at = touched[k];
            const bool isHidden = at.x1 < at.x0 || at.y1 < at.y0;
            (isHidden ? hidden : visible) += 1;
            if (center.z + radius <= 0.0F) {
                CHECK(isHidden);
                continue;
            }
            if (perspective && center.z <= 1.00011F * radius) {
                if (center.z < 1.00009F * radius)
                    CHECK((at.x0 == 0 && at.y0 == 0 && at.x1 == frame.width - 1 && at.y1 == frame.height - 1));
                continue;
            }
            const auto holds = [](int first, int last, std::pair<double, double> ends, int count) {
                // The bounds contain all touched pixels, and exceed the projection by one pixel and a fraction on each
                // side at most.
                const double low = std::max(0.0, ends.first);
                const double high = std::min(static_cast<double>(count), ends.second);
                if (low > high) return true;
                return first <= std::max(0.0, low - 0.9) && last + 1 >= std::min(high + 0.9, double(count)) &&
                       (first == 0 || first > low - 2.1) && (last == count - 1 || last < high + 1.1);
            };
            const double middleX = 0.5 * frame.width;
            const double middleY = 0.5 * frame.height;
            const auto [left, right] =
                projected(center.x, center.z, radius, perspective, middleX / double(frame.halfWidth));
            const auto [down, up] =
                projected(center.y, center.z, radius, perspective, middleY / double(frame.halfHeight));
            if (right > -middleX && left < middleX && up > -middleY && down < middleY) CHECK(!isHidden);
            if (isHidden) continue;
            CHECK(holds(at.x0, at.x1, {middleX + left, middleX + right}, frame.width));
            CHECK(holds(at.y0, at.y1, {middleY - up, middleY - down}, frame.height));
        }
        CHECK(visible > 300);
        CHECK(hidden > 50);
    }
}

TEST_CASE("Each cell lists the items that have it, in their order") {
    std::mt19937 random(7);
    const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    for (const auto& [columns, rows] : {std::pair{1, 1}, std::pair{7, 5}, std::pair{1, 40}, std::pair{33, 2}}) {
        for (const std::uint32_t count : {0U, 1U, 200U}) {
            std::vector<render::CellItem> items;
            for (std::uint32_t k = 0; k < count; ++k) {
                const int x = below(columns);
                const int y = below(rows);
                items.push_back({1000 - k, {x, y, x + below(columns - x), y + below(rows - y)}});
            }
            items.push_back({1, {0, 0, columns - 1, rows - 1}});
            const render::CellLists lists = render::binIntoCells(items, columns, rows);
            REQUIRE(lists.begin.size() == static_cast<std::size_t>(columns * rows) + 1);
            CHECK(lists.begin.back() == lists.items.size());
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    std::vector<std::uint32_t> expected;
                    for (const render::CellItem& item : items)
                        if (column >= item.cells.x0 && column <= item.cells.x1 && row >= item.cells.y0 &&
                            row <= item.cells.y1)
                            expected.push_back(item.index);
                    const std::size_t cell = lists.cellIndex(column, row);
                    CHECK(std::vector(lists.items.begin() + lists.begin[cell],
                                      lists.items.begin() + lists.begin[cell + 1]) == expected);
                }
            }
        }
    }
    for (const render::Rect outside : {render::Rect{0, 0, 4, 2}, render::Rect{-1, 0, 1, 2}, render::Rect{0, 0, 1, 3},
                                       render::Rect{0, -1, 1, 2}, render::Rect{2, 0, 1, 2}, render::Rect{0, 2, 1, 1}})
        CHECK_THROWS_AS(render::binIntoCells(std::vector{render::CellItem{0, outside}}, 4, 3), std::logic_error);
}

TEST_CASE("Lists stay short: a small sphere touches few tiles") {
    const render::CameraFrame frame = render::cameraFrame(render::Camera{}, {1280, 720});
    const std::vector<render::ViewSphere> spheres(1000, {{0.05F, 0.05F, 10.0F}, 0.05F});
    // 0.1 m at a distance of 10 m are 10 pixels here, 12 with the margin: at most 2 x 2 tiles.
    CHECK(render::binToTiles(frame, spheres, render::pixelBounds(frame, spheres)).items.size() <= 4000);
}
