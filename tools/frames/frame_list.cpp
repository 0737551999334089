// Reads the text of --frames, and writes it.
#include "tools/frames/frame_list.h"

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

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<int> numberIn(std::string_view text) {
    return parseNumber(trimmed(text));
}

/// The range that a text without commas spells; nothing if it is not of the form A, A-B, A-, A-B:S or A-:S.
std::optional<FrameRange> rangeOf(std::string_view text, int count) {
    const std::size_t dash = text.find('-');
    const auto first = numberIn(text.substr(0, dash));
    if (dash == std::string_view::npos) return first ? std::optional(FrameRange{*first, *first}) : std::nullopt;
    const std::string_view rest = text.substr(dash + 1);
    const std::size_t colon = rest.find(':');
    const std::string_view end = trimmed(rest.substr(0, colon));
    const auto last = end.empty() ? count - 1 : parseNumber(end);
    const auto step = colon == std::string_view::npos ? 1 : numberIn(rest.substr(colon + 1));
    if (!first || !last || !step) return std::nullopt;
    return FrameRange{*first, *last, *step};
}

/// What may have been meant by a part of a list that is no frame and no range.
std::string suggestionFor(std::string_view part) {
    if (part.empty()) return "there is nothing between two commas or at an end";
    const std::string quoted = fmt::format("\"{}\" is no frame and no range", part);
    if (part.front() == '-') return quoted + "; frames are counted from 0";
    if (const std::size_t dots = part.find(".."); dots != std::string_view::npos)
        return fmt::format("{}; did you mean {}-{}?", quoted, part.substr(0, dots), part.substr(dots + 2));
    if (part.find_first_not_of("0123456789 ") == std::string_view::npos)
        return quoted + "; frames are separated by commas";
    return quoted +
           "; write frames A, ranges A-B or A- and every S-th frame of a range A-B:S, separated by commas, "
           "e.g. 0-119:10 or 3,7,60-";
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
    for (std::string rest; std::getline(parts, rest, ',');) {
        const std::string_view part = trimmed(rest);
        const auto range = rangeOf(part, count);
        if (!range) throw scenes::InputError(flag, suggestionFor(part));
        if (range->step < 1)
            throw scenes::InputError(flag, fmt::format("the step of {} is {}, must be at least 1", part, range->step));
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

std::string listText(const std::vector<int>& frames) {
    std::string text;
    for (std::size_t first = 0; first < frames.size();) {
        std::size_t last = first;
        const int step = first + 1 < frames.size() ? frames[first + 1] - frames[first] : 1;
        while (last + 1 < frames.size() && frames[last + 1] - frames[last] == step) ++last;
        // Two frames that are not neighbors are no range.
        if (last == first + 1 && step > 1) last = first;
        if (!text.empty()) text += ',';
        text += std::to_string(frames[first]);
        if (last > first) text += fmt::format("-{}", frames[last]);
        if (last > first && step > 1) text += fmt::format(":{}", step);
        first = last + 1;
    }
    return text;
}

}  // namespace tools
