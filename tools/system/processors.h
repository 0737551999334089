// How many processors this process may use. Called where a command is given no number of threads.
#pragma once

#include <filesystem>

namespace tools {

/// The processors that the process may run on (sched_getaffinity: taskset, SLURM, cpusets), but no more than the quota
/// of its control group gives time for (cpu.max: docker --cpus, Kubernetes). At least 1.
int usableProcessors();

/// How many processors' worth of time a control group may use, by the quotas of the group and of all groups around it;
/// infinity without a quota.
/// @param membership  the file that lists a process's groups, /proc/self/cgroup
/// @param mounts      the folder where the groups are mounted, /sys/fs/cgroup
double processorQuota(const std::filesystem::path& membership, const std::filesystem::path& mounts);

}  // namespace tools
