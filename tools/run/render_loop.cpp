// A oneTBB pipeline of in-order stages. With one thread the stages take turns.
#include "tools/run/render_loop.h"

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <array>
#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/view/frame_view.h"
#include "tools/run/frame_sequence.h"
#include "tools/run/open_renderer.h"
#include "tools/run/state_sequence.h"
#include "tools/system/json.h"
#include "tools/system/memory.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

/// Number of frames in the pipeline at the same time. Chosen: one for each of the three stages, and one more to even
/// out their times.
constexpr std::size_t kTokens = 4;

/// A frame on its way through the stages.
struct FrameInFlight {
    SequencedFrame frame;
    render::LayerSelection wanted;     ///< what is drawn of the frame
    std::optional<render::View> view;  ///< view to draw; empty once it is drawn, and for frames that are not drawn
    bool isDropped = false;            ///< whether the run stopped or failed before the frame was drawn
    render::Layers layers;             ///< what was drawn, and what earlier frames have left, whose memory is reused
};

using Formats = std::vector<const render::PictureFormat*>;

std::vector<FrameNames> namesOf(const Formats& formats) {
    std::vector<FrameNames> names;
    for (const render::PictureFormat* format : formats) names.push_back(pictureNames(*format));
    return names;
}

/// The layers that files of some formats are made of.
render::LayerSelection layersOf(const Formats& formats) {
    render::LayerSelection all;
    for (const render::PictureFormat* format : formats) {
        all.image |= format->layers.image;
        all.color |= format->layers.color;
        all.points |= format->layers.points;
        all.ids |= format->layers.ids;
    }
    return all;
}

render::PictureScale scaleOf(const scenes::Scene& scene) {
    return {scene.size, scenes::depthRange(scene) / render::kNoDepth};
}

/// What run.json says of depth pictures; null if there are none.
Json depthJson(const RenderJob& job) {
    for (const render::PictureFormat* format : job.formats)
        if (format->name == "depth")
            return {{"meters_per_step", scaleOf(*job.scene).depthStep}, {"nothing", render::kNoDepth}};
    return nullptr;
}

/// Everything that determines the bytes of the frames of a run.
Json identityOf(const RenderJob& job, const RendererRecord& renderer) {
    constexpr std::array kNames = {"draft", "normal", "final"};
    Json identity = sceneIdentity(*job.scene);
    identity["size"] = {job.scene->size.width, job.scene->size.height};
    identity["quality"] = kNames[static_cast<std::size_t>(job.quality)];
    addTo(identity, renderer);
    return identity;
}

/// One run of the pipeline; simulate(), draw() and encode() are its stages.
class RenderRun {
 public:
    explicit RenderRun(const RenderJob& job)
        : job_(job),
          opened_(openRenderer(job)),
          progress_(job.title, job.frames.count(), job.verbosity),
          folder_(openFolder(job, opened_.record)),
          frames_(openSource(job, folder_.get(), progress_)) {
        report().threads = job.threads;
        report().renderer = opened_.record;
        report().depth = depthJson(job);
        if (job.videoPath.empty()) return;
        render::VideoOptions options = videoOptions(job);
        options.mustStop = [this] { return frames_->mustStop(); };
        video_ = std::make_unique<render::VideoWriter>(options);
    }

    FinishedRun all() {
        {
            const Stopwatch watch(report().seconds.all);
            onThreads(job_.threads, [this] { runPipeline(); });
            frames_->finish();
            if (video_ && report().frames > 0 && !report().isCutShort) finishVideo();
        }
        return frames_->take();
    }

 private:
    static std::unique_ptr<FrameFolder> openFolder(const RenderJob& job, const RendererRecord& renderer) {
        if (!job.folder) return nullptr;
        // The encoder is checked first, so that no frames of another run are removed for a video that cannot be made.
        if (!job.videoPath.empty() && job.folder->overwrite) {
            render::requireEncoder(videoOptions(job));
            const render::AtomicFile canBeCreated(job.videoPath);
        }
        return std::make_unique<FrameFolder>(*job.folder, namesOf(job.formats), job.frames, identityOf(job, renderer));
    }

    static render::VideoOptions videoOptions(const RenderJob& job) {
        render::VideoOptions options;
        options.path = job.videoPath;
        options.size = job.scene->size;
        options.frameRate = job.scene->fps;
        return options;
    }

    static std::unique_ptr<FrameSource> openSource(const RenderJob& job, FrameFolder* folder, Progress& progress) {
        if (job.states != nullptr)
            return std::make_unique<StateSequence>(*job.scene, job.frames, *job.states, folder, progress);
        return std::make_unique<FrameSequence>(*job.scene, job.frames, SequenceOptions{folder, job.estimatesErrors},
                                               progress);
    }

    void runPipeline() {
        constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
        const auto simulates = tbb::make_filter<void, FrameInFlight*>(kInOrder, [this](tbb::flow_control& flow) {
            FrameInFlight* frame = nullptr;
            keepFailure([&] { frame = simulate(); });
            if (frame == nullptr) flow.stop();
            return frame;
        });
        const auto draws = tbb::make_filter<FrameInFlight*, FrameInFlight*>(kInOrder, [this](FrameInFlight* frame) {
            keepFailure([&] { draw(*frame); });
            return frame;
        });
        const auto encodes = tbb::make_filter<FrameInFlight*, void>(
            kInOrder, [this](FrameInFlight* frame) { keepFailure([&] { encode(*frame); }); });
        tbb::parallel_pipeline(kTokens, simulates & draws & encodes);
        if (failure_) std::rethrow_exception(failure_);
    }

    /// Runs a stage for one frame. If it throws, the run ends, and runPipeline() throws the first of such exceptions at
    /// its end. The exception must not reach oneTBB, which would cancel the loops that the other stages are running:
    /// they would go on with results of which parts were never computed.
    template <class Stage>
    void keepFailure(const Stage& stage) {
        try {
            stage();
        } catch (...) {
            const std::lock_guard lock(failureMutex_);
            if (!failure_) failure_ = std::current_exception();
            hasFailed_ = true;
            frames_->abort();
        }
    }

    /// Returns nullptr after the last frame.
    FrameInFlight* simulate() {
        auto frame = frames_->next();
        if (!frame) return nullptr;
        // The stages are in order, so the frame that used this slot before has left the pipeline.
        FrameInFlight& flight = flights_[startedCount_++ % kTokens];
        flight.frame = std::move(*frame);
        flight.wanted = layersOf(formatsToMake(flight.frame));
        if (!flight.wanted.any()) return &flight;
        flight.view = scenes::frameView(*job_.scene, frames_->simulation());
        if (flight.wanted.ids) flight.view->particleIds = frames_->simulation().particles.id;
        return &flight;
    }

    /// The formats whose files of a frame have to be made.
    Formats formatsToMake(const SequencedFrame& frame) const {
        if (!frame.isWanted || frame.isKept) return {};
        Formats formats = job_.formats;
        if (folder_)
            std::erase_if(formats,
                          [&](const auto* each) { return folder_->isKept(frame.number, pictureNames(*each)); });
        return formats;
    }

    void draw(FrameInFlight& flight) {
        flight.isDropped = true;  // unless it gets to the end
        if (frames_->mustStop()) return;
        if (flight.view) drawView(flight);
        flight.isDropped = false;
    }

    void drawView(FrameInFlight& flight) {
        const Stopwatch watch(report().seconds.drawing);
        const Progress::Work work(progress_, fmt::format("drawing frame {}", flight.frame.number));
        // Drawing is isolated, so that a thread that waits for others in it does not take up the simulation of another
        // frame while it holds the OpenGL context.
        tbb::this_task_arena::isolate([&] { opened_.renderer->draw(*flight.view, flight.wanted, flight.layers); });
        flight.view.reset();
    }

    void encode(FrameInFlight& flight) {
        if (flight.isDropped || hasFailed_) return;
        const Stopwatch watch(report().seconds.encoding);
        const SequencedFrame& frame = flight.frame;
        for (const render::PictureFormat* format : formatsToMake(frame)) {
            if (!folder_ && !job_.pipesFrames) continue;
            const std::vector<std::uint8_t> bytes = format->encode(scaleOf(*job_.scene), flight.layers);
            if (folder_) folder_->write(frame.number, pictureNames(*format), bytes, frame.stateHash);
            if (job_.pipesFrames) writeStandardOutput(bytes);
        }
        frames_->storeCheckpoint(frame);
        if (!frame.isWanted) return;
        if (video_)
            unlessStopped([&] { video_->add(flight.wanted.image ? flight.layers.image : readKept(frame.number)); });
        ++report().frames;
        progress_.frameDone(frame.number, frame.time);
    }

    void finishVideo() {
        const Progress::Work work(progress_, "completing the video");
        if (!unlessStopped([&] { video_->finish(); })) frames_->recordInterrupt();
    }

    /// Works on the video. Returns false where that failed because the run must stop; there will be no video then.
    template <class Work>
    bool unlessStopped(const Work& work) {
        try {
            work();
            return true;
        } catch (const render::SystemError&) {
            if (!frames_->mustStop()) throw;
            return false;
        }
    }

    /// Reads the picture of a frame whose file existed before the run.
    render::Image readKept(int frame) const {
        const std::filesystem::path path = folder_->pathOf(frame);
        return render::decodePng(readFile(path), path.string());
    }

    RunReport& report() { return frames_->report(); }

    const RenderJob& job_;
    OpenedRenderer opened_;
    Progress progress_;
    std::unique_ptr<FrameFolder> folder_;
    std::unique_ptr<FrameSource> frames_;
    std::array<FrameInFlight, kTokens> flights_;
    std::size_t startedCount_ = 0;
    std::unique_ptr<render::VideoWriter> video_;
    std::mutex failureMutex_;
    std::exception_ptr failure_;  ///< what the first stage that failed has thrown
    std::atomic<bool> hasFailed_ = false;
};

}  // namespace

FinishedRun renderFrames(const RenderJob& job) {
    const render::PictureSize size = job.scene->size;
    return withMemoryForPictures(size.width, size.height, [&] { return RenderRun(job).all(); });
}

}  // namespace tools
