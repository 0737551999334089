// Progress of long work: a line that is drawn again and again on a terminal, a plain line every few seconds elsewhere,
// one JSON object a frame for scripts, or nothing. A thread of its own shows that work goes on while no frame is
// completed. The JSON goes to standard output, because it is a result that was asked for; everything else goes to
// standard error.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tools {

/// What a command prints besides its errors, as set by --quiet and --json.
enum class Verbosity { normal, quiet, json };

/// The line of progress on a terminal: title, bar and parts. What has no room is left out: first the bar, then the last
/// parts, then the title, which is also cut.
/// @param title  names the work; may hold any bytes
/// @param share  share of the work that is done, 0 to 1; nothing if it is not known, and then there is no bar
/// @param parts  what the line says, in ASCII, the most important first; at least one
/// @param columns  width of the terminal. A few columns stay free, because a terminal may wrap a full line.
std::string progressLine(const std::string& title, std::optional<double> share, std::vector<std::string> parts,
                         int columns);

/// All functions may be called from several threads at the same time.
class Progress {
 public:
    /// @param title  names the work in every line
    /// @param total  how many frames will be done; 0 if that is not known
    Progress(std::string title, int total, Verbosity verbosity);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

    Verbosity verbosity() const { return verbosity_; }

    /// Counts one more frame as done.
    /// @param frame  its number, printed in JSON
    /// @param sceneTime  its time, in seconds
    void frameDone(int frame, double sceneTime);

    /// Tells that a frame was simulated that --frames does not list.
    /// @param wanted  the next frame that it lists
    void frameSkipped(int frame, double sceneTime, int wanted);

    /// Tells that a step of the simulation begins, at a time in seconds. Costs no more than a few stores.
    void stepBegins(double time);

    /// Removes the line from a terminal, so that something else can be printed. It is drawn again when it changes.
    void hide();

    /// Something that is under way while the object exists. It is shown once it has taken a few seconds.
    class Work {
     public:
        /// @param what  for example "drawing frame 3"
        Work(Progress& progress, std::string what);
        /// The simulation from one time to another, in seconds. Only one at a time.
        /// @param what  for example "frame 3"
        Work(Progress& progress, std::string what, double from, double to);
        ~Work();
        Work(const Work&) = delete;
        Work& operator=(const Work&) = delete;

     private:
        friend class Progress;
        Progress& progress_;
        std::string what_;
        double from_ = 0.0;
        double to_ = 0.0;  ///< equal to from_ if this is no simulation
        std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    };

 private:
    using Clock = std::chrono::steady_clock;

    /// Counts frames over time.
    struct Pace {
        Clock::time_point start = Clock::now();
        int count = 0;
    };

    void showInTurn();
    void show(bool isFrame);
    std::vector<std::string> parts() const;
    std::string textOf(const Work& work) const;

    const std::string title_;
    const int total_;
    const Verbosity verbosity_;
    const bool isTerminal_;

    std::mutex mutex_;  ///< guards what follows up to the atomics
    Pace done_;
    Pace skipped_;
    int lastSkipped_ = 0;         ///< frame that was skipped last
    int skippedTo_ = 0;           ///< frame for which frames are skipped now; 0 if they are not
    std::vector<Work*> works_;    ///< in the order in which they began
    Clock::time_point lastLine_;  ///< when something was printed last, or the start
    bool hasLine_ = false;        ///< whether anything was printed
    bool isEnding_ = false;

    std::atomic<double> stepTime_ = 0.0;    ///< when the present step began, s
    std::atomic<double> stepLength_ = 0.0;  ///< length of the step before it, s; 0 before the second step

    std::condition_variable ending_;
    std::thread thread_;  ///< shows the progress now and then; not started if there is nothing to show
};

}  // namespace tools
