// Searches for particles and points of emission inside obstacles, with the signed distances that contacts use. Only the
// centers of particles count: a particle that lies on a surface is where it belongs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include "engine/core/parallel.h"
#include "engine/neighbors/pair_estimate.h"
#include "scenes/warnings/start_findings.h"

namespace scenes {
namespace {

/// A gap between two obstacles, in radii, in which a particle has no room. Chosen: half of what it takes up.
constexpr double kNarrowGap = 1.0;

/// Most distances to obstacles that are computed. Chosen: they take about a second.
constexpr double kMostDistances = 1e8;

/// Normals of surfaces whose product is below this face each other. Chosen: they are more than 120 degrees apart.
constexpr double kFacing = -0.5;

/// A sample of so many points that their distances to the obstacles can be computed.
std::vector<std::uint32_t> sampleAgainst(std::size_t pointCount, std::size_t obstacleCount) {
    const double distances = static_cast<double>(pointCount) * static_cast<double>(obstacleCount);
    return engine::sampleOf(pointCount, engine::strideFor(distances, kMostDistances));
}

/// Points inside an obstacle, or particles in a gap.
struct Finding {
    std::size_t count = 0;
    std::uint32_t first = 0;                ///< index of the first of them
    double depth = 0.0;                     ///< of the deepest, m
    std::array<std::size_t, 2> sides = {};  ///< the obstacles beside the gap of the first

    Finding& operator+=(const Finding& other) {
        if (count == 0) {
            first = other.first;
            sides = other.sides;
        }
        count += other.count;
        depth = std::max(depth, other.depth);
        return *this;
    }
};

/// Where particles start or are emitted.
struct Places {
    const std::vector<engine::Vec3>& points;
    std::span<const std::uint32_t> sample;              ///< indices of the points that are examined
    std::function<double(std::uint32_t index)> radius;  ///< of the particle at the point of an index, m
    std::string what;                                   ///< what is at a point, "particle" or "point of emission"
};

/// How deep the center of a particle is in an obstacle, m; 0 where it is not, or less than kInsideDepth.
double depthIn(const engine::Obstacles& obstacles, std::size_t obstacle, const engine::Vec3& point, double radius) {
    double depth = 0.0;
    forEachSurfaceNear(obstacles, obstacle, point, radius,
                       [&](const engine::Surface& surface) { depth = std::max(depth, -surface.height); });
    return depth > kInsideDepth * radius ? depth : 0.0;
}

bool isContainer(const engine::Obstacle& obstacle) {
    return std::holds_alternative<engine::Container>(obstacle);
}

/// Index of a container that holds a particle; nothing if none does.
std::optional<std::size_t> containerAround(const engine::Obstacles& obstacles, const engine::Vec3& point,
                                           double radius) {
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k)
        if (isContainer(obstacles.shapes[k]) && depthIn(obstacles, k, point, radius) == 0.0) return k;
    return std::nullopt;
}

/// The places that are inside an obstacle. Those outside a container, but in another one, are not among them: their
/// containers contradict each other.
Finding findInside(const engine::Obstacles& obstacles, std::size_t obstacle, const Places& places) {
    return engine::sumOver<Finding>(places.sample.size(), [&](std::size_t k) {
        const std::uint32_t p = places.sample[k];
        const double depth = depthIn(obstacles, obstacle, places.points[p], places.radius(p));
        const bool isElsewhere = depth > 0.0 && isContainer(obstacles.shapes[obstacle]) &&
                                 containerAround(obstacles, places.points[p], places.radius(p));
        return depth > 0.0 && !isElsewhere ? Finding{1, p, depth} : Finding{};
    });
}

/// The places outside a container and inside another one, the first one's second.
Finding findInOtherContainer(const engine::Obstacles& obstacles, std::size_t container, const Places& places) {
    return engine::sumOver<Finding>(places.sample.size(), [&](std::size_t k) {
        const std::uint32_t p = places.sample[k];
        const double depth = depthIn(obstacles, container, places.points[p], places.radius(p));
        if (depth == 0.0) return Finding{};
        const auto other = containerAround(obstacles, places.points[p], places.radius(p));
        return other ? Finding{1, p, depth, {container, *other}} : Finding{};
    });
}

/// Where the points of a finding are: "inside obstacle 1, a plane, up to 2 m deep, e.g. at
/// (0, 1, 0)".
std::string insideText(const Scene& scene, std::size_t obstacle, const Finding& finding, const engine::Vec3& first) {
    const bool isOutside = isContainer(scene.setup.obstacles.shapes[obstacle]);
    return fmt::format("{} {}, up to {:.2g} m {}, e.g. at {}", isOutside ? "outside" : "inside",
                       obstacleText(scene, obstacle), finding.depth, isOutside ? "in the solid around it" : "deep",
                       positionText(first));
}

/// What may be the mistake where particles start in an obstacle, or what to change.
/// @param hasMost  whether the obstacle contains most of what there is
const char* adviceFor(const engine::Obstacle& obstacle, bool hasMost) {
    if (isContainer(obstacle)) return "make the container larger, or move what is outside it";
    if (!std::holds_alternative<engine::Plane>(obstacle)) return "move one of the two, or make it smaller";
    return hasMost ? "is its normal flipped?" : "move them to the side that its normal points to";
}

/// Number of places that those of a finding in a sample stand for.
double weightOf(const Places& places) {
    return static_cast<double>(places.points.size()) /
           static_cast<double>(std::max<std::size_t>(1, places.sample.size()));
}

void findParticlesInside(const Scene& scene, const Places& particles, StartMessages& messages) {
    const engine::Obstacles& obstacles = scene.setup.obstacles;
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k) {
        const Finding finding = findInside(obstacles, k, particles);
        if (finding.count == 0) continue;
        messages.add(scene.tables.obstacles[k],
                     fmt::format("{} {} in {}; {}",
                                 countText(finding.count, weightOf(particles), "particle starts", "particles start"),
                                 insideText(scene, k, finding, particles.points[finding.first]),
                                 bodyText(scene, bodyOf(scene, finding.first)),
                                 adviceFor(obstacles.shapes[k], 2 * finding.count > particles.sample.size())));
    }
    messages.endKind();
}

void findSitesInside(const Scene& scene, std::size_t emitter, const Places& sites, StartMessages& messages) {
    const engine::Obstacles& obstacles = scene.setup.obstacles;
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k) {
        const Finding finding = findInside(obstacles, k, sites);
        if (finding.count == 0) continue;
        messages.add(scene.tables.emitters[emitter],
                     fmt::format("{} of {} points of emission are {}; {}",
                                 weightOf(sites) > 1.0
                                     ? fmt::format("about {:.2g}", static_cast<double>(finding.count) * weightOf(sites))
                                     : fmt::to_string(finding.count),
                                 sites.points.size(), insideText(scene, k, finding, sites.points[finding.first]),
                                 adviceFor(obstacles.shapes[k], 2 * finding.count > sites.sample.size())));
    }
}

/// Containers that hold different things: each pushes out, or into its walls, what the other one holds.
/// @param where  says of which body or emitter the place of an index is
void findContradictions(const Scene& scene, const Places& places,
                        const std::function<std::string(std::uint32_t)>& where, StartMessages& messages) {
    const engine::Obstacles& obstacles = scene.setup.obstacles;
    std::set<std::pair<std::size_t, std::size_t>> reported;
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k) {
        if (!isContainer(obstacles.shapes[k])) continue;
        const Finding finding = findInOtherContainer(obstacles, k, places);
        if (finding.count == 0 || !reported.insert(std::minmax(k, finding.sides[1])).second) continue;
        messages.add(
            scene.tables.obstacles[k],
            fmt::format(
                "containers contradict each other: {}, e.g. at {} in {}, outside obstacle {}, but inside obstacle "
                "{} (line {}); a container keeps everything in the scene inside, so make one container around "
                "all, with boxes as walls in it",
                countText(finding.count, weightOf(places), (places.what + " is").c_str(),
                          (places.what + "s are").c_str()),
                positionText(places.points[finding.first]), where(finding.first), k + 1, finding.sides[1] + 1,
                scene.tables.obstacles[finding.sides[1]].line));
    }
}

/// Whether a particle that is inside no obstacle lies between two surfaces that face each other and leave it no room.
Finding narrowGapAt(const Scene& scene, std::uint32_t p) {
    struct Side {
        engine::Surface surface;
        std::size_t obstacle = 0;
    };
    constexpr std::size_t kMostSides = 8;  // a particle in a corner touches three surfaces
    const double radius = scene.setup.initial.radius[p];
    const engine::Vec3& position = scene.setup.initial.position[p];
    const engine::Obstacles& obstacles = scene.setup.obstacles;
    std::array<Side, kMostSides> sides;
    std::size_t count = 0;
    Finding finding;
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k)
        forEachSurfaceNear(obstacles, k, position, radius, [&](const engine::Surface& surface) {
            if (count == kMostSides || surface.height < -kInsideDepth * radius) return;
            for (const Side& side : std::span(sides).first(count))
                if (engine::dot(side.surface.normal, surface.normal) < kFacing &&
                    side.surface.height + surface.height < kNarrowGap * radius)
                    finding = {1, p, 0.0, {side.obstacle, k}};
            sides[count++] = {surface, k};
        });
    return finding;
}

void findNarrowGaps(const Scene& scene, const Places& particles, StartMessages& messages) {
    const Finding finding = engine::sumOver<Finding>(
        particles.sample.size(), [&](std::size_t k) { return narrowGapAt(scene, particles.sample[k]); });
    if (finding.count == 0) return;
    messages.add(
        scene.tables.obstacles[finding.sides[1]],
        fmt::format(
            "{}, the first of them between {}, and {}, at {} in {}; leave a diameter between the two, or nothing",
            countText(finding.count, weightOf(particles), "particle has no room", "particles have no room"),
            obstacleText(scene, finding.sides[0]), obstacleText(scene, finding.sides[1]),
            positionText(particles.points[finding.first]), bodyText(scene, bodyOf(scene, finding.first))));
    messages.endKind();
}

void findAboutEmitters(const Scene& scene, StartMessages& messages) {
    const std::size_t obstacleCount = scene.setup.obstacles.shapes.size();
    for (std::size_t e = 0; e < scene.setup.emitters.size(); ++e) {
        const engine::Emitter& emitter = scene.setup.emitters[e];
        const double radius = scene.setup.materials[emitter.material].radius;
        const std::vector<std::uint32_t> sample = sampleAgainst(emitter.sites.size(), obstacleCount);
        std::vector<engine::Vec3> points;
        for (const engine::Vec3& site : emitter.sites)
            points.push_back(engine::launchAt(emitter, emitter.start, {site, engine::Vec3::Zero()}).position);
        const Places sites{points, sample, [&](std::uint32_t) { return radius; }, "point of emission"};
        findSitesInside(scene, e, sites, messages);
        findContradictions(
            scene, sites,
            [&](std::uint32_t) { return fmt::format("emitter {} (line {})", e + 1, scene.tables.emitters[e].line); },
            messages);
    }
    messages.endKind();
}

}  // namespace

void findInsideObstacles(const Scene& scene, StartMessages& messages) {
    const engine::Particles& initial = scene.setup.initial;
    const std::vector<std::uint32_t> sample = sampleAgainst(initial.count(), scene.setup.obstacles.shapes.size());
    const Places particles{initial.position, sample, [&](std::uint32_t p) { return initial.radius[p]; }, "particle"};
    findParticlesInside(scene, particles, messages);
    findContradictions(
        scene, particles, [&](std::uint32_t p) { return bodyText(scene, bodyOf(scene, p)); }, messages);
    messages.endKind();
    findNarrowGaps(scene, particles, messages);
    findAboutEmitters(scene, messages);
}

}  // namespace scenes
