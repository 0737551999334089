// Control groups of either version of Linux's interface: version 2 writes "QUOTA PERIOD" or "max PERIOD" into one file,
// version 1 has a file for each, with -1 for no quota.
#include "tools/system/processors.h"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace tools {
namespace {

namespace fs = std::filesystem;

constexpr double kNoQuota = std::numeric_limits<double>::infinity();

/// Processors that the process may run on.
int processorsByAffinity() {
    // The kernel rejects a mask with fewer bits than it has processors.
    for (std::size_t bits = 1024; bits <= std::size_t{1} << 20U; bits *= 2) {
        cpu_set_t* const mask = CPU_ALLOC(bits);
        if (mask == nullptr) break;
        const std::size_t size = CPU_ALLOC_SIZE(bits);
        const int count = ::sched_getaffinity(0, size, mask) == 0 ? CPU_COUNT_S(size, mask) : 0;
        CPU_FREE(mask);
        if (count > 0) return count;
    }
    return static_cast<int>(std::thread::hardware_concurrency());
}

/// Quota of one group: time of all its processes together over real time.
double quotaOf(const fs::path& group) {
    double quota = 0.0;
    double period = 0.0;
    std::ifstream both(group / "cpu.max");
    std::ifstream quotaFile(group / "cpu.cfs_quota_us");
    std::ifstream periodFile(group / "cpu.cfs_period_us");
    const bool isRead = both ? static_cast<bool>(both >> quota >> period)
                             : static_cast<bool>(quotaFile >> quota && periodFile >> period);
    return isRead && quota > 0.0 && period > 0.0 ? quota / period : kNoQuota;
}

/// Least quota of a group and of the groups around it, up to the folder where groups are mounted.
double quotaAround(const fs::path& mount, const fs::path& group) {
    double least = quotaOf(mount);
    fs::path around = mount;
    for (const fs::path& name : group.relative_path()) {
        around /= name;
        least = std::min(least, quotaOf(around));
    }
    return least;
}

}  // namespace

double processorQuota(const fs::path& membership, const fs::path& mounts) {
    double least = kNoQuota;
    std::ifstream lines(membership);
    for (std::string line; std::getline(lines, line);) {
        // number:controllers:group; version 2 has the number 0 and no controllers
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = line.substr(second + 1);
        if (controllers.empty()) least = std::min(least, quotaAround(mounts, group));
        if (("," + controllers + ",").find(",cpu,") != std::string::npos)
            least = std::min({least, quotaAround(mounts / "cpu", group), quotaAround(mounts / controllers, group)});
    }
    return least;
}

ProcessorKind processorKind(const fs::path& description) {
    ProcessorKind kind;
    const auto take = [](std::string& text, const std::string& value) {
        if (text.empty()) text = value;
    };
    std::ifstream lines(description);
    for (std::string line; std::getline(lines, line);) {
        // A name, blanks, a colon, a blank and a value; an empty line follows each processor.
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::string name = line.substr(0, line.find_last_not_of(" \t:", colon) + 1);
        const std::string value = line.substr(std::min(line.size(), colon + 2));
        if (name == "vendor_id" || name == "CPU implementer") take(kind.vendor, value);
        if (name == "model name" || name == "CPU part") take(kind.model, value);
    }
    return kind;
}

int usableProcessors() {
    const double quota = processorQuota("/proc/self/cgroup", "/sys/fs/cgroup");
    return std::max(1, static_cast<int>(std::min<double>(processorsByAffinity(), quota)));
}

}  // namespace tools
