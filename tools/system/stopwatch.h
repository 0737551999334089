// Wall-clock seconds of a stage, for the report of a run.
#pragma once

#include <chrono>

namespace tools {

/// Adds the life time of the object to a sum of seconds.
class Stopwatch {
 public:
    explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
    double& sum_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace tools
