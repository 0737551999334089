// Collects the messages about a scene's start, and puts into words what they name.
#include "scenes/warnings/start_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "scenes/text/input_error.h"
#include "scenes/warnings/emission_warnings.h"
#include "scenes/warnings/start_findings.h"

namespace scenes {
namespace {

/// Most messages about one kind of finding. Chosen: as many as one reads.
constexpr std::size_t kMostMessages = 8;

}  // namespace

void StartMessages::add(const SourcePosition& table, const std::string& message) {
    if (++ofThisKind_ <= kMostMessages)
        list_.push_back(formatProblem({scene_.sourceName, table.line, table.column, message}));
}

void StartMessages::endKind() {
    if (ofThisKind_ > kMostMessages)
        list_.push_back(
            fmt::format("{}: and {} more like the one before", scene_.sourceName, ofThisKind_ - kMostMessages));
    ofThisKind_ = 0;
}

std::string countText(std::size_t count, double weight, const char* one, const char* many) {
    const double all = static_cast<double>(count) * weight;
    return weight > 1.0 ? fmt::format("about {:.2g} {}", all, many)
                        : fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string positionText(const engine::Vec3& position) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", position.x(), position.y(), position.z());
}

std::string bodyText(const Scene& scene, std::size_t body) {
    return fmt::format("body {} (line {})", body + 1, scene.tables.bodies[body].line);
}

std::uint32_t bodyOf(const Scene& scene, std::uint32_t particle) {
    const std::vector<std::size_t>& ends = scene.tables.bodyEnds;
    return static_cast<std::uint32_t>(std::upper_bound(ends.begin(), ends.end(), particle) - ends.begin());
}

std::string obstacleText(const Scene& scene, std::size_t obstacle) {
    constexpr std::array kShapes = {"plane", "container", "box", "sphere", "solid of revolution", "mesh"};
    static_assert(kShapes.size() == std::variant_size_v<engine::Obstacle>);
    return fmt::format("obstacle {}, a {}", obstacle + 1, kShapes[scene.setup.obstacles.shapes[obstacle].index()]);
}

std::vector<std::string> startWarnings(const Scene& scene) {
    StartMessages messages(scene);
    findInsideObstacles(scene, messages);
    findClosePairs(scene, messages);
    findEmptyPicture(scene, messages);
    std::vector<std::string> warnings = std::move(messages).list();
    for (std::string& warning : emissionWarnings(scene)) warnings.push_back(std::move(warning));
    return warnings;
}

std::string missedErrorWarning(const Scene& scene, double error) {
    const SourcePosition& position = scene.tables.error;
    const double digit = std::pow(10.0, std::floor(std::log10(error)));
    return formatProblem(
        {scene.sourceName, position.line, position.column,
         fmt::format(
             "an error of {:g} radii a second is wanted, but the first frames come to {:.2g}; ask for "
             "physics.error = {:g} if that will do, or start the particles farther apart or slower, so that they "
             "collide less hard",
             scene.setup.error, error, std::ceil(error / digit) * digit)});
}

}  // namespace scenes
