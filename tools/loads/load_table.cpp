// Numbers are written with as many digits as it takes to read them back exactly, so that equal runs have equal files.
#include "tools/loads/load_table.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace tools {
namespace {

using engine::ObstacleLoad;
using engine::Vec3;

/// What the particles have done to an obstacle: the opposite of what it has given them. Subtracted from zero, because
/// the negative of zero would be written as "-0".
ObstacleLoad onObstacle(const ObstacleLoad& given) {
    return {Vec3::Zero() - given.impulse, Vec3::Zero() - given.angularImpulse, given.work};
}

Json listOf(const Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

std::string fieldsOf(const Vec3& vector) {
    return fmt::format("{},{},{}", vector.x(), vector.y(), vector.z());
}

}  // namespace

Json loadsJson(const scenes::Scene& scene, const engine::Simulation& simulation) {
    Json list = Json::array();
    for (std::size_t k = 0; k < simulation.loads.size(); ++k) {
        if (!engine::isRecorded(simulation.setup.obstacles, k)) continue;
        const ObstacleLoad load = onObstacle(simulation.loads[k]);
        list.push_back({{"obstacle", k + 1},
                        {"shape", scene.obstacleShapes[k]},
                        {"impulse", listOf(load.impulse)},
                        {"angular_impulse", listOf(load.angularImpulse)},
                        {"work", load.work}});
    }
    return list;
}

LoadTable::LoadTable(const engine::Simulation& simulation, std::string text)
    : before_(simulation.loads), text_(std::move(text)) {
    if (text_.empty() && !before_.empty()) text_ = kLoadsHead;
}

void LoadTable::add(const engine::Simulation& simulation, double time, double seconds) {
    for (std::size_t k = 0; k < before_.size(); ++k) {
        if (!engine::isRecorded(simulation.setup.obstacles, k)) continue;
        const ObstacleLoad load = onObstacle(simulation.loads[k]);
        const ObstacleLoad before = onObstacle(before_[k]);
        fmt::format_to(std::back_inserter(text_), "{},{},{},{},{},{}\n", time, k + 1,
                       fieldsOf((load.impulse - before.impulse) / seconds),
                       fieldsOf((load.angularImpulse - before.angularImpulse) / seconds), fieldsOf(load.impulse),
                       load.work);
    }
    before_ = simulation.loads;
}

}  // namespace tools
