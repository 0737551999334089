// Optimal string alignment distance by dynamic programming over three rows.
#include "scenes/text/edit_distance.h"

#include <algorithm>
#include <numeric>

namespace scenes {
namespace {

/// Longer names are never meant; the bound keeps hostile input cheap.
constexpr std::size_t kLongestName = 64;

/// One typing mistake in three characters still looks like the name; chosen by trying common slips.
std::size_t tolerated(std::size_t length) {
    return std::max<std::size_t>(1, length / 3);
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        std::swap(beforeLast, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string nearestName(std::string_view name, const std::vector<std::string>& known) {
    if (name.empty() || name.size() > kLongestName) return {};
    std::string nearest;
    std::size_t least = tolerated(name.size()) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(name, candidate);
        // A name that shares no character is never meant, however short.
        if (distance >= least || distance >= std::max(name.size(), candidate.size())) continue;
        least = distance;
        nearest = candidate;
    }
    return nearest;
}

}  // namespace scenes
