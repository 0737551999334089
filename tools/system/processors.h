// How many processors this process may use, and of which kind they are. Called where a command is given no number of
// threads, and for records of what has drawn a picture.
#pragma once

#include <filesystem>
#include <string>

namespace tools {

/// The processors that the process may run on (sched_getaffinity: taskset, SLURM, cpusets), but no more than the quota
/// of its control group gives time for (cpu.max: docker --cpus, Kubernetes). At least 1.
int usableProcessors();

/// How many processors' worth of time a control group may use, by the quotas of the group and of all groups around it;
/// infinity without a quota.
/// @param membership  the file that lists a process's groups, /proc/self/cgroup
/// @param mounts      the folder where the groups are mounted, /sys/fs/cgroup
double processorQuota(const std::filesystem::path& membership, const std::filesystem::path& mounts);

/// Maker and model of a processor; empty where they are not known.
struct ProcessorKind {
    std::string vendor;  ///< "GenuineIntel", "AuthenticAMD", or for ARM the code of the maker, "0x41"
    std::string model;
};

/// The kind of this machine's processors.
/// @param description  the file in which Linux describes them
ProcessorKind processorKind(const std::filesystem::path& description = "/proc/cpuinfo");

}  // namespace tools
