// Progress of long work: a bar on a terminal, a plain line every few seconds elsewhere, one JSON object a frame for
// scripts, or nothing. The JSON goes to standard output, because it is a result that was asked for; everything else
// goes to standard error.
#pragma once

#include <chrono>
#include <string>

namespace tools {

/// What a command prints besides its errors, as set by --quiet and --json.
enum class Verbosity { normal, quiet, json };

class Progress {
 public:
    /// @param title  names the work in every line
    /// @param total  how many frames will be done
    Progress(std::string title, int total, Verbosity verbosity);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    /// Counts one more frame as done.
    /// @param frame  its number, printed in plain lines and JSON
    /// @param sceneTime  its time, in seconds
    void frameDone(int frame, double sceneTime);

 private:
    std::string title_;
    int total_ = 0;
    int doneCount_ = 0;
    Verbosity verbosity_;
    bool isTerminal_ = false;
    std::chrono::steady_clock::time_point start_;
    double lastLineSeconds_ = 0.0;  ///< when the last plain line was printed, in seconds after the start
};

}  // namespace tools
