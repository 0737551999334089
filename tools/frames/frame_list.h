// The frames that a run makes, as --frames of `render` and `simulate` names them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tools {

/// Frame numbers in increasing order, at least one.
struct FrameList {
    std::vector<int> numbers = {0};

    int first() const { return numbers.front(); }
    int last() const { return numbers.back(); }
    int count() const { return static_cast<int>(numbers.size()); }

    /// How many frames of the list come before this one; nothing if it is not in the list.
    std::optional<int> indexOf(int frame) const;
};

/// How --frames is written, for the help of the commands.
inline constexpr const char* kFrameListHelp =
    "frames A, ranges A-B or A- (up to the last frame) and every S-th frame of a range A-B:S, separated by commas and "
    "counted from 0 (default: all)";

/// The frames that a text such as "5", "0-119", "60-", "0-119:10" or "3, 7, 20-30" names, each once; an empty text
/// stands for all. These are also the lists that render farms hand to a task (Open Job Description, Flamenco).
/// @param count  the scene has frames 0 to count - 1
/// @throws scenes::InputError for anything else, and for frames that the scene does not have
FrameList frameList(const std::string& text, int count);

/// A text that frameList() reads as these frames, such as "0-29,47,60-90:2"; empty without frames.
/// @param frames  in increasing order
std::string listText(const std::vector<int>& frames);

}  // namespace tools
