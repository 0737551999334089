// Solids are divided where the surface area heuristic (MacDonald and Booth 1990) expects rays to meet the fewest boxes
// and solids, among 16 places along the longest side of the box around their centers. Large parts are divided in
// parallel. Each part has room for as many nodes as it may need, so that the tree does not depend on the number of
// threads.
#include "render/prepare/rays/solid_tree.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/parallel_invoke.h>

#include "render/picture/bounds.h"
#include "render/picture/parallel_loops.h"
#include "render/prepare/cells/hit_ids.h"

namespace render {

namespace {

constexpr std::size_t kLeafSize = 4;  // most solids of a leaf
constexpr std::size_t kBins = 16;     // chosen: more make trees no better
// Depth from which solids are halved wherever they are: below 2^32 of them are at most kDeepestTree levels deep.
constexpr int kDeepestByArea = kDeepestTree - 32;
constexpr std::size_t kSerialSize = 2048;  // fewer solids than this are divided by one thread; chosen: 0.5 ms of work

/// A solid and the box around it.
struct BoundedSolid {
    Bounds<glm::vec3> bounds;
    std::int32_t id = 0;

    glm::vec3 center() const { return 0.5F * (bounds.low + bounds.high); }
};

/// Half the surface of a box, m^2; 0 for an empty one.
float halfArea(const Bounds<glm::vec3>& box) {
    const glm::vec3 size = max(box.high - box.low, glm::vec3(0.0F));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// Solids whose centers lie in one of kBins parts of a box.
struct Bin {
    Bounds<glm::vec3> bounds;
    std::size_t count = 0;

    void add(const Bin& other) {
        if (other.count == 0) return;
        bounds.add(other.bounds.low, other.bounds.high);
        count += other.count;
    }
    /// Expected cost of the solids, in cost of one times area.
    float cost() const { return halfArea(bounds) * static_cast<float>(count); }
};

/// The bin after which solids are best divided.
std::size_t bestSplit(const std::array<Bin, kBins>& bins) {
    std::array<float, kBins> costAfter{};  // of all bins after each
    Bin after;
    for (std::size_t k = kBins - 1; k > 0; --k) {
        after.add(bins[k]);
        costAfter[k - 1] = after.cost();
    }
    Bin before;
    std::size_t best = 0;
    float least = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
        before.add(bins[k]);
        const float cost = before.cost() + costAfter[k];
        if (cost >= least) continue;
        least = cost;
        best = k;
    }
    return best;
}

class TreeBuild {
 public:
    TreeBuild(std::span<BoundedSolid> solids, SolidTree& tree) : solids_(solids), tree_(tree) {}

    /// Fills in a node that holds solids.
    /// @param next  index of the first node that is free for its descendants
    /// @param depth  of the node below the root
    void fill(std::size_t node, std::size_t first, std::size_t count, std::size_t next, int depth = 0) {
        Bounds<glm::vec3> bounds;
        Bounds<glm::vec3> centers;
        for (const BoundedSolid& solid : solids_.subspan(first, count)) {
            bounds.add(solid.bounds.low, solid.bounds.high);
            centers.add(solid.center());
        }
        tree_.nodes[node] = {bounds.low, static_cast<std::uint32_t>(first), bounds.high,
                             static_cast<std::uint32_t>(count)};
        if (count <= kLeafSize) return;
        tree_.nodes[node].first = static_cast<std::uint32_t>(next);
        tree_.nodes[node].count = 0;
        const std::size_t half = depth < kDeepestByArea ? divide(first, count, centers) : count / 2;
        // A part of n solids has at most 2 n - 1 nodes, of which this one has placed the first.
        const std::size_t nextOfSecond = next + 2 * half;
        const auto fillFirst = [&] { fill(next, first, half, next + 2, depth + 1); };
        const auto fillSecond = [&] { fill(next + 1, first + half, count - half, nextOfSecond, depth + 1); };
        if (count < kSerialSize) {
            fillFirst();
            fillSecond();
        } else {
            tbb::parallel_invoke(fillFirst, fillSecond);
        }
    }

 private:
    /// Moves the solids of the first part to the front. @return their number
    std::size_t divide(std::size_t first, std::size_t count, const Bounds<glm::vec3>& centers) {
        const std::span<BoundedSolid> part = solids_.subspan(first, count);
        const glm::vec3 size = centers.high - centers.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const float scale = static_cast<float>(kBins) / std::max(size[axis], std::numeric_limits<float>::min());
        const auto binOf = [&](const BoundedSolid& solid) {
            const float at = (solid.center()[axis] - centers.low[axis]) * scale;
            return std::min(static_cast<std::size_t>(std::max(at, 0.0F)), kBins - 1);
        };
        std::array<Bin, kBins> bins;
        for (const BoundedSolid& solid : part) bins[binOf(solid)].add({solid.bounds, 1});
        const std::size_t split = bestSplit(bins);
        const auto middle =
            std::stable_partition(part.begin(), part.end(), [&](const auto& solid) { return binOf(solid) <= split; });
        const auto half = static_cast<std::size_t>(middle - part.begin());
        // Solids with the same center cannot be told apart: any two halves will do.
        return half == 0 || half == count ? count / 2 : half;
    }

    std::span<BoundedSolid> solids_;
    SolidTree& tree_;
};

std::vector<BoundedSolid> boundedSolids(std::span<const ViewSphere> spheres, std::span<const BoxObstacle> boxes,
                                        const DrawnMeshes& meshes, glm::vec3 eye) {
    std::vector<BoundedSolid> solids(spheres.size() + boxes.size() + meshes.triangles.size());
    const std::span sphereSolids(solids.data(), spheres.size());
    const std::span boxSolids(solids.data() + spheres.size(), boxes.size());
    const std::span triangleSolids(solids.data() + spheres.size() + boxes.size(), meshes.triangles.size());
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const ViewSphere& sphere = spheres[k];
        sphereSolids[k] = {{sphere.center - sphere.radius, sphere.center + sphere.radius},
                           static_cast<std::int32_t>(k)};
    }
    for (std::size_t k = 0; k < boxes.size(); ++k)
        boxSolids[k] = {{boxes[k].minimum - eye, boxes[k].maximum - eye}, kHitBox + 16 * static_cast<std::int32_t>(k)};
    forAll(triangleSolids.size(), [&](std::size_t k) {
        BoundedSolid& solid = triangleSolids[k];
        for (const std::uint32_t corner : meshes.triangles[k].corners) solid.bounds.add(meshes.positions[corner]);
        solid.id = kHitTriangle + static_cast<std::int32_t>(k);
    });
    return solids;
}

}  // namespace

SolidTree solidTree(std::span<const ViewSphere> spheres, std::span<const BoxObstacle> boxes, const DrawnMeshes& meshes,
                    glm::vec3 eye) {
    std::vector<BoundedSolid> solids = boundedSolids(spheres, boxes, meshes, eye);
    SolidTree tree;
    if (solids.empty()) return tree;
    tree.nodes.resize(2 * solids.size() - 1);
    TreeBuild(solids, tree).fill(0, 0, solids.size(), 1);
    for (const BoundedSolid& solid : solids) tree.solids.push_back(solid.id);
    return tree;
}

}  // namespace render
