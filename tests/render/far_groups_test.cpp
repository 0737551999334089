// Groups of particles that lie apart, and that those far away change nothing of the others' smooth skin: what the mesh
// and the field have of a scene is what the picture, which leaves out such particles, has of it.
#include "tests/catch.h"

#include <algorithm>
#include <random>

#include "render/picture/camera_frame.h"
#include "render/prepare/cells/strays.h"
#include "render/prepare/skin/skin.h"
#include "tests/render/pictures.h"

namespace {

using Groups = std::vector<std::vector<std::uint32_t>>;

std::vector<render::Sphere> particlesAt(const std::vector<glm::vec3>& centers) {
    std::vector<render::Sphere> particles;
    for (const glm::vec3& center : centers) particles.push_back({center, 0.1F, glm::vec3(0.5F)});
    return particles;
}

/// The groups, sorted by their first index.
Groups groupsOf(const std::vector<glm::vec3>& centers, float gap, double mostCells) {
    Groups groups = render::separateGroups(particlesAt(centers), gap, mostCells);
    std::ranges::sort(groups);
    return groups;
}

render::View smoothCloud() {
    render::View view = pictures::cloud(400);
    view.style = render::Style::metaballs;
    view.field.skin = render::Skin::smooth;
    return view;
}

/// Behind the camera, beside it, above the picture, far below the ground, and over the horizon at the side.
const std::vector<glm::vec3> kDirections = {
    {0.3F, 0.2F, 0.9F}, {1.0F, 0.0F, 0.0F}, {-0.3F, 0.9F, -0.3F}, {0.0F, -1.0F, 0.1F}, {-0.9F, 0.0F, -0.4F}};

render::View withStrays(render::View view, float distance) {
    for (const glm::vec3 direction : kDirections)
        view.particles.push_back({distance * glm::normalize(direction), 0.1F, glm::vec3(0.5F)});
    return view;
}

bool isSame(const render::SkinBall& a, const render::SkinBall& b) {
    return a.center == b.center && a.weight == b.weight && a.reach == b.reach;
}

}  // namespace

TEST_CASE("Particles are parted at gaps alone, and only where the box around them is large", "[groups]") {
    const std::vector<glm::vec3> row = {
        {0.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {10.0F, 0.0F, 0.0F}};
    CHECK(groupsOf(row, 2.0F, 5.0) == Groups{{0, 2}, {1, 3}});
    CHECK(groupsOf(row, 2.0F, 6.0).empty());  // 10 m are six cells of 2 m, at most
    CHECK(groupsOf(row, 8.0F, 1.0).empty());  // a gap is wider than 8 m
    CHECK(groupsOf(row, 7.9F, 1.0) == Groups{{0, 2}, {1, 3}});
    // Two in a plane that only another axis parts, and one apart from both.
    CHECK(groupsOf({{0.0F, 0.0F, 0.0F}, {0.0F, 50.0F, 0.0F}, {70.0F, 50.0F, 0.0F}}, 2.0F, 5.0) ==
          Groups{{0}, {1}, {2}});
    CHECK(groupsOf({}, 2.0F, 5.0).empty());
    CHECK(groupsOf({{1e9F, 0.0F, 0.0F}}, 2.0F, 5.0).empty());
}

TEST_CASE("Groups have every particle once, and lie apart", "[groups]") {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        std::vector<glm::vec3> centers;
        for (int k = 0; k < 100; ++k) {
            const auto at = [&] { return 0.1F * static_cast<float>(random() % 1000); };
            const float x = at(), y = at(), z = at();
            centers.emplace_back(x, y, z);
        }
        const float gap = 1.0F + 0.5F * static_cast<float>(round);
        const Groups groups = groupsOf(centers, gap, 1.0);
        std::vector<std::uint32_t> all;
        for (std::size_t a = 0; a < groups.size(); ++a) {
            CHECK(std::ranges::is_sorted(groups[a]));
            all.insert(all.end(), groups[a].begin(), groups[a].end());
            for (std::size_t b = 0; b < a; ++b)
                for (const std::uint32_t i : groups[a])
                    for (const std::uint32_t j : groups[b]) REQUIRE(glm::distance(centers[i], centers[j]) > gap);
        }
        if (round == 0) REQUIRE(groups.size() > 5);
        if (groups.empty()) continue;
        std::ranges::sort(all);
        REQUIRE(all.size() == centers.size());
        CHECK(std::ranges::adjacent_find(all) == all.end());
    }
}

TEST_CASE("Particles far away change nothing of the others' smooth skin", "[groups]") {
    const render::View view = smoothCloud();
    const std::vector<render::SkinBall> alone = render::skinOf(view);
    for (const float distance : {3e3F, 1e5F, 1e7F}) {
        const render::View strewn = withStrays(view, distance);
        const std::vector<render::SkinBall> skin = render::skinOf(strewn);
        const auto near = render::withoutStrays(strewn, render::cameraFrame(view.camera, {160, 90}));
        REQUIRE(near);
        REQUIRE(near->particles.size() == alone.size());  // the picture's skin is that of the cloud alone
        INFO("at " << distance << " m");
        for (std::size_t k = 0; k < alone.size(); ++k) REQUIRE(isSame(skin[k], alone[k]));
        for (std::size_t k = alone.size(); k < skin.size(); ++k)
            CHECK(isSame(skin[k], {strewn.particles[k].center, 1.0F, 0.1F * view.field.reach}));
    }
    // Nearer ones share a grid with the others, whose sums are then rounded in another order.
    const std::vector<render::SkinBall> skin = render::skinOf(withStrays(view, 50.0F));
    for (std::size_t k = 0; k < alone.size(); ++k) {
        CHECK(glm::distance(skin[k].center, alone[k].center) < 1e-5F);
        CHECK(skin[k].weight == Approx(alone[k].weight).epsilon(1e-5));
    }
}
