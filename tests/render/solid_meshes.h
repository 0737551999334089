// Solid meshes for the tests of the renderers: surfaces of revolution around the y axis, and a box.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

#include "tests/render/pictures.h"

namespace pictures {

using SolidMesh = std::shared_ptr<const render::SolidMesh>;

/// A point of a closed profile, with its outward normal: x is the distance from the axis, y the height.
struct ProfilePoint {
    glm::dvec2 at{0.0};
    glm::dvec2 normal{0.0};
};

/// Turns a closed profile, which runs counterclockwise in the half plane right of the axis, around the axis.
/// @param isClosed  whether the last point is connected with the first; otherwise both lie on the axis
inline SolidMesh turned(const std::vector<ProfilePoint>& profile, bool isClosed, int segments) {
    auto mesh = std::make_shared<render::SolidMesh>();
    const auto rows = static_cast<std::uint32_t>(profile.size());
    const auto columns = static_cast<std::uint32_t>(segments);
    for (std::uint32_t column = 0; column < columns; ++column) {
        const double angle = 2.0 * std::numbers::pi * column / segments;
        const auto around = [&](glm::dvec2 p) {
            return glm::vec3(glm::dvec3(p.x * std::cos(angle), p.y, -p.x * std::sin(angle)));
        };
        for (const ProfilePoint& point : profile) {
            mesh->positions.push_back(around(point.at));
            mesh->normals.push_back(around(point.normal));
        }
    }
    for (std::uint32_t column = 0; column < columns; ++column) {
        for (std::uint32_t row = 0; row + (isClosed ? 0 : 1) < rows; ++row) {
            const std::uint32_t above = (row + 1) % rows;
            const std::uint32_t here = column * rows;
            const std::uint32_t next = (column + 1) % columns * rows;
            if (profile[row].at.x > 0.0) mesh->triangles.push_back({here + row, next + row, next + above});
            if (profile[above].at.x > 0.0) mesh->triangles.push_back({here + row, next + above, here + above});
        }
    }
    return mesh;
}

inline SolidMesh meshSphere(double radius, int segments) {
    std::vector<ProfilePoint> profile;
    for (int k = 0; k <= segments / 2; ++k) {
        const double angle = std::numbers::pi * (2.0 * k / segments - 0.5);
        const bool isPole = k == 0 || k == segments / 2;
        const glm::dvec2 normal{isPole ? 0.0 : std::cos(angle), std::sin(angle)};
        profile.push_back({radius * normal, normal});
    }
    return turned(profile, false, segments);
}

/// @param ring  distance of the tube's middle from the axis, m
inline SolidMesh meshTorus(double ring, double tube, int segments) {
    std::vector<ProfilePoint> profile;
    for (int k = 0; k < segments / 2; ++k) {
        const double angle = 4.0 * std::numbers::pi * k / segments;
        const glm::dvec2 normal{std::cos(angle), std::sin(angle)};
        profile.push_back({glm::dvec2(ring, 0.0) + tube * normal, normal});
    }
    return turned(profile, true, segments);
}

/// A half sphere that is open above, with a wall of a thickness and a round rim.
inline SolidMesh meshBowl(double radius, double thickness, int segments) {
    std::vector<ProfilePoint> profile;
    const int steps = segments / 4;
    for (int k = 0; k <= steps; ++k) {
        const double angle = 0.5 * std::numbers::pi * (static_cast<double>(k) / steps - 1.0);
        const glm::dvec2 normal{k == 0 ? 0.0 : std::cos(angle), std::sin(angle)};
        profile.push_back({radius * normal, normal});
    }
    for (int k = 1; k < 8; ++k) {
        const double angle = std::numbers::pi * k / 8.0;
        const glm::dvec2 normal{std::cos(angle), std::sin(angle)};
        profile.push_back({glm::dvec2(radius - 0.5 * thickness, 0.0) + 0.5 * thickness * normal, normal});
    }
    for (int k = steps; k >= 0; --k) {
        const double angle = 0.5 * std::numbers::pi * (static_cast<double>(k) / steps - 1.0);
        const glm::dvec2 normal{k == 0 ? 0.0 : std::cos(angle), std::sin(angle)};
        profile.push_back({(radius - thickness) * normal, -normal});
    }
    return turned(profile, false, segments);
}

/// Twelve triangles, with a normal to each face.
inline SolidMesh meshBox(glm::vec3 low, glm::vec3 high) {
    auto mesh = std::make_shared<render::SolidMesh>();
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool isHigh : {false, true}) {
            const auto first = static_cast<std::uint32_t>(mesh->positions.size());
            glm::vec3 normal(0.0F);
            normal[axis] = isHigh ? 1.0F : -1.0F;
            for (int corner = 0; corner < 4; ++corner) {
                glm::vec3 at = isHigh ? high : low;
                // Corners counterclockwise as seen from above the axis.
                at[(axis + 1) % 3] = (corner == 1 || corner == 2) ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
                at[(axis + 2) % 3] = corner >= 2 ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
                mesh->positions.push_back(at);
                mesh->normals.push_back(normal);
            }
            const std::uint32_t second = isHigh ? first + 1 : first + 3;
            const std::uint32_t last = isHigh ? first + 3 : first + 1;
            mesh->triangles.push_back({first, second, first + 2});
            mesh->triangles.push_back({first, first + 2, last});
        }
    }
    return mesh;
}

/// A rotation by an angle (rad) around an axis.
inline glm::mat3 rotationAround(glm::vec3 axis, float angle) {
    const glm::vec3 a = glm::normalize(axis);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    const auto column = [&](glm::vec3 v) { return c * v + s * glm::cross(a, v) + (1.0F - c) * glm::dot(a, v) * a; };
    return {column({1.0F, 0.0F, 0.0F}), column({0.0F, 1.0F, 0.0F}), column({0.0F, 0.0F, 1.0F})};
}

/// The cloud with a sphere, a torus, a box and a bowl among the particles, all of them meshes.
inline render::View cloudWithMeshes(int count) {
    render::View view = cloud(count);
    view.meshObstacles.push_back({meshSphere(0.45, 48), glm::mat3(1.0F), {-1.4F, 0.5F, 1.4F}, {0.8F, 0.2F, 0.2F}});
    view.meshObstacles.push_back(
        {meshTorus(0.5, 0.17, 64), rotationAround({1.0F, 0.2F, 0.1F}, 1.1F), {0.9F, 1.0F, 1.3F}, {0.9F, 0.6F, 0.1F}});
    view.meshObstacles.push_back({meshBox({-0.4F, -0.3F, -0.2F}, {0.4F, 0.3F, 0.2F}),
                                  rotationAround({0.3F, 1.0F, 0.2F}, 0.6F),
                                  {1.7F, 0.45F, -0.6F},
                                  {0.2F, 0.3F, 0.7F}});
    view.meshObstacles.push_back(
        {meshBowl(0.7, 0.06, 64), rotationAround({0.0F, 0.0F, 1.0F}, 0.2F), {-0.1F, 0.75F, 1.9F}, {0.3F, 0.7F, 0.4F}});
    return view;
}

}  // namespace pictures
