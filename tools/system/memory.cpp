// Says how much memory was asked for, how much the program had taken, and what the system allows it.
#include "tools/system/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

namespace tools {
namespace {

std::string megabytes(double bytes) {
    return fmt::format("{:.0f} MB", bytes / 1e6);
}

/// The most memory that the program has taken so far, in bytes.
double peakBytes() {
    struct rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// The address space that the process may have, in words; empty if there is no limit.
std::string limitText() {
    struct rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    return fmt::format(", where ulimit -v allows {} with the program itself",
                       megabytes(static_cast<double>(limit.rlim_cur)));
}

}  // namespace

std::string memoryMessage(const std::bad_alloc& error, const std::string& purpose, const std::string& advice) {
    const auto* const failed = dynamic_cast<const AllocationError*>(&error);
    return fmt::format("memory ran out{}{}: {} asked for, after up to {} had been taken{}{}{}",
                       purpose.empty() ? "" : " while ", purpose,
                       failed == nullptr ? "more was" : megabytes(static_cast<double>(failed->bytes())) + " more were",
                       megabytes(peakBytes()), limitText(), advice.empty() ? "" : "; ", advice);
}

}  // namespace tools
