// The cells of a metaball field against its value by brute force: no cell is on a side that the field is not on, and no
// ball that reaches a subcell is missing from its list.
#include "tests/catch.h"

#include <algorithm>
#include <random>
#include <vector>

#include "render/prepare/cells/tiles.h"
#include "render/prepare/rays/ball_cells.h"
#include "render/prepare/rays/field_cells.h"
#include "render/prepare/skin/ellipsoid.h"
#include "render/prepare/skin/skin.h"

using render::Skin;

namespace {

class RandomPoints {
 public:
    explicit RandomPoints(unsigned seed) : random_(seed) {}
    float between(float low, float high) {
        return low + (high - low) * static_cast<float>(static_cast<double>(random_()) / 4294967296.0);
    }
    glm::vec3 in(glm::vec3 low, glm::vec3 high) {
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        return {x, y, between(low.z, high.z)};
    }

 private:
    std::mt19937 random_;
};

/// A heap of particles of mixed radii, with some around it.
render::View heap(Skin skin, unsigned seed) {
    RandomPoints random(seed);
    render::View view;
    view.style = render::Style::metaballs;
    view.field = {random.between(1.5F, 4.0F), skin};
    const bool isMixed = seed % 2 == 0;
    for (int k = 0; k < 400; ++k)
        view.particles.push_back({random.in({-1.0F, -0.6F, -0.8F}, {1.0F, 0.6F, 0.8F}),
                                  isMixed ? random.between(0.06F, 0.18F) : 0.12F,
                                  {0.5F, 0.5F, 0.5F}});
    for (int k = 0; k < 30; ++k)
        view.particles.push_back({random.in(glm::vec3(-3.0F), glm::vec3(3.0F)), 0.12F, {0.5F, 0.5F, 0.5F}});
    return view;
}

/// Root of a ball's kernel at a point relative to the eye, in double precision.
double rootAt(const render::BallCells& cells, std::size_t k, const glm::dvec3& point) {
    const glm::dvec3 off = point - glm::dvec3(cells.x[k], cells.y[k], cells.z[k]);
    if (!cells.isAnisotropic()) return double(cells.peak[k]) - glm::dot(off, off) * double(cells.squaredSlope[k]);
    const render::SymmetricMatrix<float> m = cells.formOf(k);
    const glm::dvec3 turned{double(m.xx) * off.x + double(m.xy) * off.y + double(m.xz) * off.z,
                            double(m.xy) * off.x + double(m.yy) * off.y + double(m.yz) * off.z,
                            double(m.xz) * off.x + double(m.yz) * off.y + double(m.zz) * off.z};
    return double(cells.peak[k]) - glm::dot(off, turned);
}

double fieldAt(const render::BallCells& cells, const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t k = 0; k < cells.particle.size(); ++k) {
        const double root = std::max(0.0, rootAt(cells, k, point));
        sum += root * root;
    }
    return sum;
}

}  // namespace

TEST_CASE("The field is on the side of the threshold that its cells say, and all balls are in their lists") {
    const Skin skin = GENERATE(Skin::plain, Skin::smooth, Skin::anisotropic);
    const unsigned seed = GENERATE(1U, 2U, 3U);
    const render::View view = heap(skin, seed);
    const glm::vec3 eye(7.0F, -2.0F, 9.0F);
    const render::BallCells cells = render::ballCells(view, render::skinOf(view), eye);
    const float threshold = render::surfaceThreshold(view.field);
    const render::FieldCells field = render::fieldCells(cells, threshold);
    REQUIRE(field.blocks.size() == render::cellIndex(cells.count, 0, 0, cells.count.z));
    RandomPoints random(seed + 10);
    int inside = 0;
    int mixed = 0;
    int wrong = 0;
    int missing = 0;
    for (int sample = 0; sample < 6000; ++sample) {
        const glm::vec3 point = random.in({-1.3F, -0.9F, -1.1F}, {1.3F, 0.9F, 1.1F}) - eye;
        const glm::vec3 at = (point - cells.low) / cells.side;
        const glm::ivec3 cell(at);
        const std::int32_t block = field.blocks[render::cellIndex(cells.count, cell.x, cell.y, cell.z)];
        render::Subcell subcell{0, block};
        if (block >= 0) {
            const auto along = static_cast<float>(field.along);
            const glm::ivec3 place(glm::min((at - glm::vec3(cell)) * along, glm::vec3(along - 1.0F)));
            subcell = field.subcells[field.subcellsOfBlock() * static_cast<std::size_t>(block) +
                                     render::cellIndex(glm::ivec3(field.along), place.x, place.y, place.z)];
        }
        const bool isAbove = fieldAt(cells, glm::dvec3(point)) >= double(threshold);
        inside += subcell.count == render::kAllInside ? 1 : 0;
        mixed += subcell.count > 0 ? 1 : 0;
        if (subcell.count <= 0) {
            wrong += (subcell.count == render::kAllInside) != isAbove ? 1 : 0;
            continue;
        }
        const auto list = field.balls.begin() + static_cast<std::ptrdiff_t>(subcell.first);
        for (std::size_t k = 0; k < cells.particle.size(); ++k)
            if (rootAt(cells, k, glm::dvec3(point)) > 0.0 && !std::binary_search(list, list + subcell.count, k))
                ++missing;
    }
    INFO("skin " << int(skin) << ", seed " << seed << ": of 6000 points " << inside << " are in cells inside, " << mixed
                 << " in mixed ones");
    CHECK(wrong == 0);
    CHECK(missing == 0);
    // The cells do sort: of the points in this dense heap some are inside for sure, and most are not in mixed cells.
    CHECK(inside > 300);
    CHECK(mixed < 4500);
}

TEST_CASE("A field without balls, and one of a single ball, have cells") {
    render::View view;
    view.style = render::Style::metaballs;
    CHECK(render::fieldCells(render::ballCells(view, {}, view.camera.eye), 0.5F).empty());
    view.particles.push_back({{0.0F, 0.0F, 0.0F}, 0.1F, {1.0F, 1.0F, 1.0F}});
    const render::BallCells cells = render::ballCells(view, render::skinOf(view), view.camera.eye);
    const render::FieldCells field = render::fieldCells(cells, render::surfaceThreshold(view.field));
    CHECK(std::ranges::any_of(field.subcells, [](const render::Subcell& subcell) { return subcell.count == 1; }));
    CHECK(std::ranges::all_of(field.subcells, [](const render::Subcell& subcell) { return subcell.count <= 1; }));
}
