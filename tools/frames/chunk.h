// A chunk of a run: every N-th of its frames, so that N processes, on one machine or on many, share them. Neighboring
// frames take about the same time to draw, so that the chunks of a run do, too. A render farm may share out frames in
// lists of its own instead.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/frames/frame_list.h"

namespace tools {

/// Chunk `index` of `count`, counted from 1, or a list of frames.
struct Chunk {
    int index = 1;
    int count = 1;
    std::string list = {};  ///< hash of the list, 16 hexadecimal digits; empty for a chunk of a count

    friend bool operator==(const Chunk&, const Chunk&) = default;
};

/// How --chunk is written, for the help of the commands.
inline constexpr const char* kChunkHelp =
    "draw one of N interleaved parts, counted from 1, of the frames: the I-th, the (I+N)-th, and so on. auto: the part "
    "of this task of a Slurm job array; auto/N: also where single tasks are resubmitted. list: the frames that "
    "--frames names, as render farms hand them out. Parts may be drawn into one folder at the same time, see assemble. "
    "Without --states each simulates from the start";

/// The chunk that a text such as "2/4", "auto" or "auto/4" names. "auto" counts the tasks of the Slurm job array that
/// the process belongs to, which must be evenly spaced. "auto/N" is chunk ID modulo N, whichever tasks the array has.
/// @param environment  returns the value of an environment variable, or nullptr, like getenv()
/// @throws scenes::InputError
Chunk parseChunk(const std::string& text, const char* (*environment)(const char*));

/// The chunk that consists of a list of frames.
Chunk chunkOfList(const FrameList& frames);

/// The frames of a chunk of a count: those of which the position in the list, counted from 0, is index - 1 modulo
/// count. Nothing if there are fewer frames than chunks before it.
std::optional<FrameList> framesOf(const FrameList& frames, const Chunk& chunk);

/// "chunk-2-of-4" or "chunk-list-0123456789abcdef", with which the names of a chunk's own files begin.
std::string nameOf(const Chunk& chunk);

/// The chunk whose own files have a name that begins like this one. Cuts its name off the text.
std::optional<Chunk> takeChunkName(std::string_view& fileName);

}  // namespace tools
