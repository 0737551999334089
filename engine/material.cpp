// Table 1 of the paper and the symmetric mix of two materials.
#include "engine/material.h"

#include <array>
#include <cmath>

namespace engine {
namespace {

struct Row {
    std::string_view name;
    double radius, b1, bd, cr, cd;
};

/// Table 1, row by row; masses are the published 1 kg.
constexpr std::array<Row, 4> kTable1 = {{
    {"liquid", 0.15, 0.01, 1.0, 1.0, 2.0},
    {"solid", 0.15, 0.8, 4.0, 2.0, 2.0},
    {"powder", 0.15, 0.8, 4.0, 1.0, 1.0},
    {"fountain", 0.15, 0.01, 1.0, 1.0, 2.0},
}};

}  // namespace

std::optional<Material> materialPreset(std::string_view name) {
    for (const Row& row : kTable1) {
        if (row.name != name) continue;
        Material material;
        material.name = row.name;
        material.radius = row.radius;
        material.repulsion = row.b1;
        material.damping = row.bd;
        material.repulsionReach = row.cr;
        material.dampingReach = row.cd;
        return material;
    }
    return std::nullopt;
}

const std::vector<std::string>& materialPresetNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Row& row : kTable1) list.emplace_back(row.name);
        return list;
    }();
    return names;
}

Material mixed(const Material& a, const Material& b) {
    Material mix;
    mix.repulsion = std::sqrt(a.repulsion * b.repulsion);
    mix.damping = std::sqrt(a.damping * b.damping);
    mix.repulsionReach = 0.5 * (a.repulsionReach + b.repulsionReach);
    mix.dampingReach = 0.5 * (a.dampingReach + b.dampingReach);
    mix.friction = std::sqrt(a.friction * b.friction);
    mix.coreFraction = 0.5 * (a.coreFraction + b.coreFraction);
    return mix;
}

}  // namespace engine
