// How long work tells about itself: a bar on a terminal, a plain line now and then elsewhere, one JSON object a frame
// for scripts, or nothing. Everything goes to stderr but the JSON, which is the result of a run that asked for it.
#pragma once

#include <chrono>
#include <string>

namespace tools {

enum class Verbosity { normal, quiet, json };

class Progress {
 public:
    /// total: how many frames will be done.
    Progress(std::string title, int total, Verbosity verbosity);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    /// One more frame is done; its number is for the reader.
    void frameDone(int frame, double sceneTime);

 private:
    void drawBar(double elapsed) const;
    void printLine(double elapsed);

    std::string title_;
    int total_ = 0;
    int done_ = 0;
    Verbosity verbosity_;
    bool terminal_ = false;
    std::chrono::steady_clock::time_point start_;
    double lastLine_ = 0.0;  ///< s after the start
};

}  // namespace tools
