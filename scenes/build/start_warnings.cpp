// Counts the particles inside obstacles with the signed distances that contacts use, and the pairs that are too close
// with a neighbor list. Only the centers of particles count: a particle that lies on a surface or touches another body
// is where it belongs.
#include "scenes/build/start_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <variant>

#include "engine/core/parallel.h"
#include "engine/force_law/obstacle_surfaces.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/neighbors/pair_estimate.h"
#include "scenes/build/emission_warnings.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

using engine::Vec3;

/// A particle whose center is this deep in an obstacle, in radii, starts inside the obstacle. Chosen: more than the
/// jitter of a body whose lattice begins on the surface.
constexpr double kInsideDepth = 0.5;

/// A gap between two obstacles, in radii, in which a particle has no room. Chosen: half of what it takes up.
constexpr double kNarrowGap = 1.0;

/// Normals of surfaces whose product is below this face each other. Chosen: they are more than 120 degrees apart.
constexpr double kFacing = -0.5;

/// Particles of different bodies that are closer than this share of their rest length show that the bodies overlap.
/// Chosen: hardly any place in a close packing is further than that from all particles (0.71 is the most), while
/// neighbors in bodies side by side, or in a liquid under its own weight, are further apart.
constexpr double kOverlapShare = 0.6;

/// Particles of one body that are closer than their core and than this share of their rest length are packed too
/// closely. Chosen: the published figures of repulsion alone start with particles at a third of it, on purpose.
constexpr double kPackedShare = 0.3;

/// A factor just below 1, with which a lattice whose spacing is a least distance is not too close by rounding.
constexpr double kRounding = 1.0 - 1e-6;

/// Most pairs of neighbors that are listed one by one, and most distances to obstacles that are computed. Chosen: one
/// or the other takes about a second.
constexpr double kMostPairs = 2e7;
constexpr double kMostDistances = 1e8;

/// Most messages about one kind of finding. Chosen: as many as one reads.
constexpr std::size_t kMostMessages = 8;

/// "1 particle", "12 particles", or "about 1.2e+04 particles" for a count in a sample, each of which stands for
/// `weight` of them.
std::string countText(std::size_t count, double weight, const char* one, const char* many) {
    const double all = static_cast<double>(count) * weight;
    return weight > 1.0 ? fmt::format("about {:.2g} {}", all, many)
                        : fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string positionText(const Vec3& position) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", position.x(), position.y(), position.z());
}

/// "body 2 (line 14)" for the body that a particle belongs to.
std::string bodyText(const Scene& scene, std::size_t body) {
    return fmt::format("body {} (line {})", body + 1, scene.tables.bodies[body].line);
}

std::uint32_t bodyOf(const Scene& scene, std::uint32_t particle) {
    const std::vector<std::size_t>& ends = scene.tables.bodyEnds;
    return static_cast<std::uint32_t>(std::upper_bound(ends.begin(), ends.end(), particle) - ends.begin());
}

/// "obstacle 3, a box".
std::string obstacleText(const Scene& scene, std::size_t obstacle) {
    constexpr std::array kShapes = {"plane", "container", "box", "sphere"};
    static_assert(kShapes.size() == std::variant_size_v<engine::Obstacle>);
    return fmt::format("obstacle {}, a {}", obstacle + 1, kShapes[scene.setup.obstacles.shapes[obstacle].index()]);
}

/// The messages of a scene's start, as they are found.
class Messages {
 public:
    explicit Messages(const Scene& scene) : scene_(scene) {}

    /// Adds a message about a table of the scene file. Of each kind of finding only the first few are kept.
    void add(const SourcePosition& table, const std::string& message) {
        if (++ofThisKind_ <= kMostMessages)
            list_.push_back(formatProblem({scene_.sourceName, table.line, table.column, message}));
    }

    void endKind() {
        if (ofThisKind_ > kMostMessages)
            list_.push_back(
                fmt::format("{}: and {} more like the one before", scene_.sourceName, ofThisKind_ - kMostMessages));
        ofThisKind_ = 0;
    }

    std::vector<std::string> list() && { return std::move(list_); }

 private:
    const Scene& scene_;
    std::vector<std::string> list_;
    std::size_t ofThisKind_ = 0;
};

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

/// Calls visit(surface) for the surfaces of an obstacle that are closer to a point than the reach (m).
template <class Visit>
void forEachSurfaceNear(const engine::Obstacle& obstacle, const Vec3& point, double reach, const Visit& visit) {
    std::visit(
        [&](const auto& shape) {
            if (!engine::mayReach(shape, point, reach)) return;
            engine::forEachSurface(shape, point, 1.0, [&](const engine::Surface& surface) {
                if (surface.height < reach) visit(surface);
            });
        },
        obstacle);
}

/// The points of a sample that are inside an obstacle.
/// @param radiusOf  radius of the particle at the point of an index, m
template <class RadiusOf>
Finding findInside(const engine::Obstacle& obstacle, const std::vector<Vec3>& points,
                   std::span<const std::uint32_t> sample, const RadiusOf& radiusOf) {
    return engine::sumOver<Finding>(sample.size(), [&](std::size_t k) {
        const std::uint32_t p = sample[k];
        double depth = 0.0;
        forEachSurfaceNear(obstacle, points[p], radiusOf(p),
                           [&](const engine::Surface& surface) { depth = std::max(depth, -surface.height); });
        return depth > kInsideDepth * radiusOf(p) ? Finding{1, p, depth} : Finding{};
    });
}

/// Where the points of a finding are, and what may be the mistake: "inside obstacle 1, a plane, up to 2 m deep, e.g. at
/// (0, 1, 0)".
std::string insideText(const Scene& scene, std::size_t obstacle, const Finding& finding, const Vec3& first) {
    const bool isContainer = std::holds_alternative<engine::Container>(scene.setup.obstacles.shapes[obstacle]);
    return fmt::format("{} {}, up to {:.2g} m {}, e.g. at {}", isContainer ? "outside" : "inside",
                       obstacleText(scene, obstacle), finding.depth, isContainer ? "in the solid around it" : "deep",
                       positionText(first));
}

/// A question that ends a message about an obstacle that contains most of what there is.
const char* hintFor(const engine::Obstacle& obstacle, bool hasMost) {
    return hasMost && std::holds_alternative<engine::Plane>(obstacle) ? "; is its normal flipped?" : "";
}

void findParticlesInside(const Scene& scene, std::uint64_t stride, Messages& messages) {
    const engine::Particles& particles = scene.setup.initial;
    const std::vector<std::uint32_t> sample = engine::sampleOf(particles.count(), stride);
    const std::vector<engine::Obstacle>& obstacles = scene.setup.obstacles.shapes;
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const Finding finding =
            findInside(obstacles[k], particles.position, sample, [&](std::size_t p) { return particles.radius[p]; });
        if (finding.count == 0) continue;
        messages.add(
            scene.tables.obstacles[k],
            fmt::format("{} {} in {}{}",
                        countText(finding.count, static_cast<double>(stride), "particle starts", "particles start"),
                        insideText(scene, k, finding, particles.position[finding.first]),
                        bodyText(scene, bodyOf(scene, finding.first)),
                        hintFor(obstacles[k], 2 * finding.count > sample.size())));
    }
    messages.endKind();
}

void findSitesInside(const Scene& scene, Messages& messages) {
    const std::vector<engine::Obstacle>& obstacles = scene.setup.obstacles.shapes;
    for (std::size_t e = 0; e < scene.setup.emitters.size(); ++e) {
        const engine::Emitter& emitter = scene.setup.emitters[e];
        const double radius = scene.setup.materials[emitter.material].radius;
        const double distances = static_cast<double>(emitter.sites.size() * obstacles.size());
        const std::uint64_t stride = engine::strideFor(distances, kMostDistances);
        const std::vector<std::uint32_t> sample = engine::sampleOf(emitter.sites.size(), stride);
        for (std::size_t k = 0; k < obstacles.size(); ++k) {
            const Finding finding =
                findInside(obstacles[k], emitter.sites, sample, [&](std::size_t) { return radius; });
            if (finding.count == 0) continue;
            messages.add(scene.tables.emitters[e],
                         fmt::format("{} of {} points of emission are {}{}",
                                     stride > 1 ? fmt::format("about {:.2g}", static_cast<double>(finding.count) *
                                                                                  static_cast<double>(stride))
                                                : fmt::to_string(finding.count),
                                     emitter.sites.size(), insideText(scene, k, finding, emitter.sites[finding.first]),
                                     hintFor(obstacles[k], 2 * finding.count > sample.size())));
        }
    }
    messages.endKind();
}

/// Whether a particle that is inside no obstacle lies between two surfaces that face each other and leave it no room.
Finding narrowGapAt(const Scene& scene, std::uint32_t p) {
    struct Side {
        engine::Surface surface;
        std::size_t obstacle = 0;
    };
    constexpr std::size_t kMostSides = 8;  // a particle in a corner touches three surfaces
    const double radius = scene.setup.initial.radius[p];
    const Vec3& position = scene.setup.initial.position[p];
    const std::vector<engine::Obstacle>& obstacles = scene.setup.obstacles.shapes;
    std::array<Side, kMostSides> sides;
    std::size_t count = 0;
    Finding finding;
    for (std::size_t k = 0; k < obstacles.size(); ++k)
        forEachSurfaceNear(obstacles[k], position, radius, [&](const engine::Surface& surface) {
            if (count == kMostSides || surface.height < -kInsideDepth * radius) return;
            for (const Side& side : std::span(sides).first(count))
                if (engine::dot(side.surface.normal, surface.normal) < kFacing &&
                    side.surface.height + surface.height < kNarrowGap * radius)
                    finding = {1, p, 0.0, {side.obstacle, k}};
            sides[count++] = {surface, k};
        });
    return finding;
}

void findNarrowGaps(const Scene& scene, std::uint64_t stride, Messages& messages) {
    const std::vector<std::uint32_t> sample = engine::sampleOf(scene.setup.initial.count(), stride);
    const Finding finding =
        engine::sumOver<Finding>(sample.size(), [&](std::size_t k) { return narrowGapAt(scene, sample[k]); });
    if (finding.count == 0) return;
    messages.add(
        scene.tables.obstacles[finding.sides[1]],
        fmt::format(
            "{}, the first of them between {}, and {}, at {} in {}",
            countText(finding.count, static_cast<double>(stride), "particle has no room", "particles have no room"),
            obstacleText(scene, finding.sides[0]), obstacleText(scene, finding.sides[1]),
            positionText(scene.setup.initial.position[finding.first]), bodyText(scene, bodyOf(scene, finding.first))));
    messages.endKind();
}

/// Pairs of particles of two bodies, or of one, that are too close.
struct ClosePairs {
    std::size_t count = 0;
    std::uint32_t first = 0;                                   ///< the first particle that is in one of them
    double closest = std::numeric_limits<double>::infinity();  ///< smallest distance, in rest lengths
};

/// Close pairs by the indices of their bodies, the lower one first.
using PairsOfBodies = std::map<std::array<std::uint32_t, 2>, ClosePairs>;

/// The distance, in rest lengths, below which two particles are too close.
double leastDistance(const Scene& scene, std::uint32_t p, std::uint32_t q, bool areOfOneBody) {
    const engine::Material& a = scene.setup.materials[scene.setup.initial.material[p]];
    const engine::Material& b = scene.setup.materials[scene.setup.initial.material[q]];
    const double core = &a == &b ? a.coreFraction : mixed(a, b).coreFraction;
    return kRounding * (areOfOneBody ? std::min(core, kPackedShare) : std::max(core, kOverlapShare));
}

/// The largest distance that may be too close, in rest lengths.
double largestLeastDistance(const Scene& scene) {
    double reach = scene.tables.bodies.size() > 1 ? kOverlapShare : 0.0;
    for (const engine::Material& material : scene.setup.materials) reach = std::max(reach, material.coreFraction);
    return reach;
}

/// The pairs in a sample of the particles that are too close.
PairsOfBodies closePairs(const Scene& scene, std::uint64_t stride) {
    const engine::Particles& particles = scene.setup.initial;
    const std::vector<std::uint32_t> sample = engine::sampleOf(particles.count(), stride);
    std::vector<Vec3> positions;
    std::vector<double> radii;
    for (const std::uint32_t p : sample) {
        positions.push_back(particles.position[p]);
        radii.push_back(particles.radius[p]);
    }
    PairsOfBodies found;
    if (sample.size() < 2) return found;
    const double largestRadius = *std::max_element(radii.begin(), radii.end());
    engine::NeighborList list;
    build(list, positions, radii, largestLeastDistance(scene) * 2.0 * largestRadius, 0.0);
    for (std::size_t slot = 0; slot < list.count(); ++slot) {
        const std::uint32_t p = sample[list.order[static_cast<std::size_t>(list.rows.ownIndices[slot])]];
        for (std::uint32_t k = 0; k < list.rows.length[slot]; ++k) {
            const std::uint32_t q = sample[list.order[list.rows.sortedIndexAt(slot, k)]];
            if (q < p) continue;
            const double distance = std::sqrt(engine::squaredLength(particles.position[p] - particles.position[q])) /
                                    (particles.radius[p] + particles.radius[q]);
            const std::array bodies = {bodyOf(scene, p), bodyOf(scene, q)};
            if (distance >= leastDistance(scene, p, q, bodies[0] == bodies[1])) continue;
            ClosePairs& pairs = found[bodies];
            if (pairs.count++ == 0 || p < pairs.first) pairs.first = p;
            pairs.closest = std::min(pairs.closest, distance);
        }
    }
    return found;
}

void findClosePairs(const Scene& scene, Messages& messages) {
    const engine::Particles& particles = scene.setup.initial;
    if (particles.count() < 2) return;
    const double largestRadius = *std::max_element(particles.radius.begin(), particles.radius.end());
    const double pairCount = engine::estimatePairCount(particles.position, particles.radius,
                                                       largestLeastDistance(scene) * 2.0 * largestRadius);
    const std::uint64_t stride =
        pairCount <= kMostPairs ? 1
                                : engine::strideFor(static_cast<double>(particles.count()), engine::kPairSampleCount);
    const double weight = static_cast<double>(stride) * static_cast<double>(stride);
    for (const auto& [bodies, pairs] : closePairs(scene, stride)) {
        const bool areOfOneBody = bodies[0] == bodies[1];
        const std::string what =
            areOfOneBody ? fmt::format("body {} starts", bodies[0] + 1)
                         : fmt::format("bodies {} and {} overlap: they start", bodies[0] + 1, bodies[1] + 1);
        messages.add(
            scene.tables.bodies[bodies[1]],
            fmt::format("{} with {} of particles closer than {}, the closest at {:.2g} rest lengths, e.g. at {}", what,
                        countText(pairs.count, weight, "pair", "pairs"),
                        areOfOneBody ? "their core" : fmt::format("{:g} rest lengths", kOverlapShare), pairs.closest,
                        positionText(scene.setup.initial.position[pairs.first])));
    }
    messages.endKind();
}

}  // namespace

std::vector<std::string> startWarnings(const Scene& scene) {
    Messages messages(scene);
    const double distances = static_cast<double>(scene.setup.initial.count() * scene.setup.obstacles.shapes.size());
    const std::uint64_t stride = engine::strideFor(distances, kMostDistances);
    findParticlesInside(scene, stride, messages);
    findNarrowGaps(scene, stride, messages);
    findSitesInside(scene, messages);
    findClosePairs(scene, messages);
    std::vector<std::string> warnings = std::move(messages).list();
    for (std::string& warning : emissionWarnings(scene)) warnings.push_back(std::move(warning));
    return warnings;
}

}  // namespace scenes
