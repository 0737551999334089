// Optimal string alignment distance by dynamic programming, of which only the last three rows are kept.
#include "scenes/text/edit_distance.h"

#include <algorithm>
#include <numeric>

namespace scenes {
namespace {

/// Names longer than this get no "did you mean": no key of a scene is nearly as long, and the time grows with the
/// square of the length.
constexpr std::size_t kMaxNameLength = 64;

/// The largest distance of a plausible typing mistake: one edit for every three characters. Chosen by trying common
/// mistakes on the names of the schema.
std::size_t maxDistance(std::size_t length) {
    return std::max<std::size_t>(1, length / 3);
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> twoRowsUp(b.size() + 1), rowUp(b.size() + 1), row(b.size() + 1);
    std::iota(rowUp.begin(), rowUp.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = rowUp[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, rowUp[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], twoRowsUp[j - 2] + 1);
        }
        std::swap(twoRowsUp, rowUp);
        std::swap(rowUp, row);
    }
    return rowUp[b.size()];
}

std::string nearestName(std::string_view name, const std::vector<std::string>& known) {
    if (name.empty() || name.size() > kMaxNameLength) return {};
    std::string nearest;
    std::size_t limit = maxDistance(name.size()) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(name, candidate);
        // At a distance as large as the longer name is long, two names have nothing in common, however short they are.
        if (distance >= limit || distance >= std::max(name.size(), candidate.size())) continue;
        limit = distance;
        nearest = candidate;
    }
    return nearest;
}

}  // namespace scenes
