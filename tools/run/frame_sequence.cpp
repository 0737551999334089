// Frames that are not wanted are also simulated one by one, so that a run that ends there early can be resumed
// close to its end.
#include "tools/run/frame_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/hash.h"
#include "engine/error_control/step_cost.h"
#include "engine/run/diagnostics.h"
#include "tools/run/run_warnings.h"
#include "tools/system/json.h"
#include "tools/system/memory.h"

namespace tools {
namespace {

/// The error of a fixed step is estimated at no more than this many frames of a run. Chosen: in a run of 240 frames
/// each estimate may then cover a whole frame.
constexpr int kErrorSampleCount = 8;

/// Whether the error is estimated at a frame: at the end of each of as many equal parts of the run.
bool isSampled(const FrameList& frames, int frame) {
    const int stride = (frames.count() - 1 + kErrorSampleCount) / kErrorSampleCount;
    const auto index = frames.indexOf(frame);
    return index && *index % stride == stride - 1;
}

/// Hash of a list of frames. Checkpoints record it, because the list decides at which frames errors are sampled.
std::string hashOf(const FrameList& frames) {
    std::uint64_t hash = engine::fnv1a({});
    for (const int frame : frames.numbers) hash = engine::fnv1a(static_cast<std::uint64_t>(frame), hash);
    return engine::hexadecimal(hash);
}

}  // namespace

FrameSequence::FrameSequence(const scenes::Scene& scene, FrameList frames, const SequenceOptions& options,
                             Progress& progress)
    : FrameSource(options.folder, progress,
                  options.host == nullptr ? SimulationHost().graceSeconds() : options.host->graceSeconds()),
      scene_(scene),
      frames_(std::move(frames)),
      estimatesErrors_(options.estimatesErrors),
      host_(options.host == nullptr ? own_ : *options.host),
      lastCheckpoint_(std::chrono::steady_clock::now()) {
    withMemoryForParticles(scene_.setup.initial.count(), [this] {
        if (folder_ == nullptr || !resume()) run_.simulation = host_.start(scene_);
    });
    if (position_ < 0) loads_ = LoadTable(run_.simulation);
    run_.simulation.beforeStep = [this](const engine::Simulation& simulation) {
        progress_.stepBegins(simulation.time);
        if (mustStop()) throw engine::Stopped();
    };
}

/// Resumes from the newest checkpoint before the first frame that has to be made, or from the newest of all if no frame
/// has to be made. Returns false if there is no checkpoint.
bool FrameSequence::resume() {
    const auto isKept = [&](int frame) { return folder_->isKept(frame); };
    const auto toMake = std::ranges::find_if_not(frames_.numbers, isKept);
    const int latest = toMake == frames_.numbers.end() ? frames_.last() : *toMake - 1;
    auto restart = folder_->restartPoint(scene_.setup, latest);
    if (!restart) return false;
    position_ = restart->frame;
    run_.simulation = std::move(restart->simulation);
    loads_ = LoadTable(run_.simulation, std::move(restart->loads));
    host_.resume(scene_, run_.simulation);
    if (estimatesErrors_ && restart->report.value("frames", Json()) == hashOf(frames_))
        run_.report.errors = decodeErrors(restart->report);
    run_.report.resumedFrom = restart->frame;
    next_ = std::min(frames_.first(), position_ + 1);
    return true;
}

Checkpoint FrameSequence::checkpoint() {
    return withMemoryForParticles(run_.simulation.particles.count(), [&] {
        return Checkpoint{host_.checkpoint(run_.simulation), loads_.text(), checkpointReport()};
    });
}

std::optional<SequencedFrame> FrameSequence::next() {
    if (next_ > frames_.last()) return std::nullopt;
    // A signal is ignored while frames that exist already are passed on for a video. That takes little time, and a
    // video of some of them would be worth less than the earlier video that it replaces.
    if (interrupts_ && (next_ > position_ || mustStop())) run_.report.interruptedBy = interrupts_->signal();
    if (run_.report.interruptedBy != 0 || mustStop()) return std::nullopt;
    SequencedFrame frame;
    frame.number = next_;
    frame.time = scenes::frameTime(scene_, frame.number);
    frame.isWanted = frames_.indexOf(frame.number).has_value();
    frame.isKept = frame.isWanted && folder_ != nullptr && folder_->isKept(frame.number);
    const bool isNew = frame.number > position_;
    const auto advance = [&] { return advanceTo(frame.number); };
    if (isNew && !withMemoryForParticles(run_.simulation.particles.count(), advance)) return std::nullopt;
    ++next_;
    if (!frame.isWanted)
        progress_.frameSkipped(frame.number, frame.time, *std::ranges::upper_bound(frames_.numbers, frame.number));
    if (folder_ == nullptr) return frame;
    if (frame.isWanted && frame.number == position_)
        run_.report.stateHash = engine::stateHash(run_.simulation.particles);
    if (frame.isWanted && !frame.isKept) frame.stateHash = run_.report.stateHash;
    const std::chrono::duration<double> sinceCheckpoint = std::chrono::steady_clock::now() - lastCheckpoint_;
    if (isNew && sinceCheckpoint.count() >= folder_->checkpointSeconds()) {
        frame.checkpoint = checkpoint();
        lastCheckpoint_ = std::chrono::steady_clock::now();
    }
    return frame;
}

/// Returns false if the simulation became unstable or had to stop. That is not thrown, because earlier frames are still
/// being written.
bool FrameSequence::advanceTo(int frame) {
    const Stopwatch watch(run_.report.seconds.simulating);
    const auto frameTime = [&](int number) { return scenes::frameTime(scene_, number); };
    const double evaluationsBefore = engine::forceEvaluationsOf(run_.simulation);
    try {
        {
            const Progress::Work work(progress_, fmt::format("frame {}", frame), run_.simulation.time,
                                      frameTime(frame));
            host_.advanceToFrame(scene_, run_.simulation, frame);
        }
        position_ = frame;
        if (frame > 0) loads_.add(run_.simulation, frameTime(frame), scene_.fps.timeOf(1));
        if (!estimatesErrors_ || !isSampled(frames_, frame)) return true;
        const Progress::Work work(progress_, fmt::format("error of frame {}", frame), frameTime(frame),
                                  frameTime(frame + 1));
        host_.addSample(run_.report.errors, run_.simulation, scene_.fps.timeOf(1),
                        engine::forceEvaluationsOf(run_.simulation) - evaluationsBefore);
        return true;
    } catch (const engine::InstabilityError& error) {
        run_.report.unstable = error.what();
    } catch (const engine::Stopped&) {
        // finish() reports it.
    }
    return false;
}

Json FrameSequence::checkpointReport() const {
    Json report = encodeErrors(run_.report.errors);
    if (estimatesErrors_) report["frames"] = hashOf(frames_);
    return report;
}

void FrameSequence::finish() {
    RunReport& report = run_.report;
    // A simulation that became unstable or was stopped has no state of a frame, and a checkpoint needs all frames
    // before it to be written.
    if (recordStop() || !report.unstable.empty()) return;
    if (folder_ != nullptr && position_ >= 0) folder_->writeCheckpoint(position_, checkpoint());
    report.stateHash = engine::stateHash(run_.simulation.particles);
    run_.energy = host_.energy(run_.simulation);
}

FinishedRun FrameSequence::take() {
    if (folder_ != nullptr) {
        run_.json = runJson(scene_, run_);
        warnOfStrays(run_.simulation);
        folder_->writeLoads(loads_.text());
        folder_->writeReport(run_.json);
    }
    run_.simulation.beforeStep = nullptr;  // refers to this object
    return std::move(run_);
}

}  // namespace tools
