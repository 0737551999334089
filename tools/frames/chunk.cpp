// Reads the text of --chunk.
#include "tools/frames/chunk.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/hash.h"
#include "scenes/text/input_error.h"
#include "tools/system/text.h"

namespace tools {
namespace {

constexpr std::string_view kAuto = "auto";
constexpr std::string_view kListPrefix = "chunk-list-";

/// The chunk of a list whose files have a name that begins like this one. Cuts its name off the text.
std::optional<Chunk> takeListName(std::string_view& fileName) {
    constexpr std::size_t kHashLength = 16;
    const std::string_view hash =
        fileName.starts_with(kListPrefix) ? fileName.substr(kListPrefix.size(), kHashLength) : std::string_view();
    if (hash.size() != kHashLength || hash.find_first_not_of("0123456789abcdef") != std::string_view::npos)
        return std::nullopt;
    fileName.remove_prefix(kListPrefix.size() + kHashLength);
    return Chunk{1, 1, std::string(hash)};
}

/// The largest number of chunks. Chosen: no scene has more frames by default.
constexpr int kMostChunks = 100000;

/// The environment of a task of a Slurm job array.
struct SlurmArray {
    const std::string& flag;
    const char* (*environment)(const char*);

    /// A whole number that a variable has.
    /// @throws scenes::InputError if it has none
    int number(const char* name) const {
        const char* const text = environment(name);
        if (text == nullptr)
            throw scenes::InputError(
                flag, fmt::format("{} is not set, so this is no task of a Slurm job array; elsewhere write --chunk I/N",
                                  name));
        const auto value = parseNumber(text);
        if (!value || *value < 0)
            throw scenes::InputError(flag, fmt::format("{} is \"{}\", must be a whole number >= 0", name, text));
        return *value;
    }
};

/// The chunk of the task among all tasks of its array.
Chunk chunkOfTask(const SlurmArray& array) {
    const int task = array.number("SLURM_ARRAY_TASK_ID");
    const int first = array.number("SLURM_ARRAY_TASK_MIN");
    const int last = array.number("SLURM_ARRAY_TASK_MAX");
    const int step = array.number("SLURM_ARRAY_TASK_STEP");
    const bool isEven = step > 0 && first <= task && task <= last && (task - first) % step == 0 &&
                        (last - first) / step + 1 == array.number("SLURM_ARRAY_TASK_COUNT");
    if (!isEven)
        throw scenes::InputError(
            array.flag, fmt::format("task {} belongs to an array that is not evenly spaced from {} to {}; with auto/N "
                                    "any tasks can be submitted",
                                    task, first, last));
    return {(task - first) / step + 1, (last - first) / step + 1, {}};
}

}  // namespace

Chunk parseChunk(const std::string& text, const char* (*environment)(const char*)) {
    const std::string flag = "--chunk " + text;
    const SlurmArray array{flag, environment};
    if (text == kAuto) return chunkOfTask(array);
    const std::size_t slash = text.find('/');
    const std::string_view first = std::string_view(text).substr(0, slash);
    const auto count =
        slash == std::string::npos ? std::nullopt : parseNumber(std::string_view(text).substr(slash + 1));
    if (!count || *count < 1 || *count > kMostChunks)
        throw scenes::InputError(
            flag, fmt::format("must be I/N, chunk I of N (1 to {}), in a Slurm job array auto or auto/N, or list",
                              kMostChunks));
    if (first == kAuto) return {array.number("SLURM_ARRAY_TASK_ID") % *count + 1, *count, {}};
    const auto index = parseNumber(first);
    if (!index || *index < 1 || *index > *count)
        throw scenes::InputError(flag, fmt::format("there are chunks 1/{0} to {0}/{0}", *count));
    return {*index, *count, {}};
}

std::optional<FrameList> framesOf(const FrameList& frames, const Chunk& chunk) {
    FrameList part{{}};
    for (int position = chunk.index - 1; position < frames.count(); position += chunk.count)
        part.numbers.push_back(frames.numbers[static_cast<std::size_t>(position)]);
    return part.numbers.empty() ? std::nullopt : std::optional(part);
}

Chunk chunkOfList(const FrameList& frames) {
    return {1, 1, engine::hexadecimal(engine::fnv1a(listText(frames.numbers)))};
}

std::string nameOf(const Chunk& chunk) {
    if (!chunk.list.empty()) return fmt::format("{}{}", kListPrefix, chunk.list);
    return fmt::format("chunk-{}-of-{}", chunk.index, chunk.count);
}

std::optional<Chunk> takeChunkName(std::string_view& fileName) {
    const auto numberAfter = [](std::string_view& text, std::string_view beginning) -> std::optional<int> {
        if (!text.starts_with(beginning)) return std::nullopt;
        const std::size_t end = std::min(text.find_first_not_of("0123456789", beginning.size()), text.size());
        const auto number = parseNumber(text.substr(beginning.size(), end - beginning.size()));
        text.remove_prefix(end);
        return number;
    };
    if (auto list = takeListName(fileName)) return list;
    std::string_view rest = fileName;
    const auto index = numberAfter(rest, "chunk-");
    const auto count = index ? numberAfter(rest, "-of-") : std::nullopt;
    if (!count) return std::nullopt;
    const Chunk chunk{*index, *count, {}};
    const bool isWritten = 1 <= chunk.index && chunk.index <= chunk.count && fileName.starts_with(nameOf(chunk));
    if (!isWritten) return std::nullopt;
    fileName = rest;
    return chunk;
}

}  // namespace tools
