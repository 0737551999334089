// Reads the text of --frames.
#include "tools/run/frame_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <sstream>

#include "scenes/text/input_error.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// The frames first, first + step, ... up to the last.
struct FrameRange {
    int first = 0;
    int last = 0;
    int step = 1;
};

/// The range that a text without commas spells; nothing if it is not of the form A, A-B, A-, A-B:S or A-:S.
std::optional<FrameRange> rangeOf(std::string_view text, int count) {
    const std::size_t dash = text.find('-');
    const auto first = parseNumber(text.substr(0, dash));
    if (dash == std::string_view::npos) return first ? std::optional(FrameRange{*first, *first}) : std::nullopt;
    const std::string_view end = text.substr(dash + 1);
    const std::size_t colon = end.find(':');
    const auto last = end.empty() || colon == 0 ? count - 1 : parseNumber(end.substr(0, colon));
    const auto step = colon == std::string_view::npos ? 1 : parseNumber(end.substr(colon + 1));
    if (!first || !last || !step || *step < 1) return std::nullopt;
    return FrameRange{*first, *last, *step};
}

}  // namespace

std::optional<int> FrameList::indexOf(int frame) const {
    const auto found = std::ranges::lower_bound(numbers, frame);
    if (found == numbers.end() || *found != frame) return std::nullopt;
    return static_cast<int>(found - numbers.begin());
}

FrameList frameList(const std::string& text, int count) {
    const std::string flag = "--frames " + text;
    FrameList frames{{}};
    std::istringstream parts((text.empty() ? "0-" : text) + ",");
    for (std::string part; std::getline(parts, part, ',');) {
        const auto range = rangeOf(part, count);
        if (!range)
            throw scenes::InputError(flag,
                                     "must be frames A, ranges A-B or A- and every S-th frame of a range A-B:S, "
                                     "separated by commas, e.g. 0-119:10 or 3,7,60-");
        if (std::max(range->first, range->last) >= count)
            throw scenes::InputError(flag, fmt::format("the scene has frames 0 to {}", count - 1));
        if (range->first > range->last)
            throw scenes::InputError(
                flag, fmt::format("the first frame, {}, comes after the last, {}", range->first, range->last));
        for (std::int64_t frame = range->first; frame <= range->last; frame += range->step)
            frames.numbers.push_back(static_cast<int>(frame));
    }
    std::ranges::sort(frames.numbers);
    const auto repeated = std::unique(frames.numbers.begin(), frames.numbers.end());
    frames.numbers.erase(repeated, frames.numbers.end());
    return frames;
}

}  // namespace tools
