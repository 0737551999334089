// An oneTBB pipeline of in-order stages. With one thread its stages take turns.
#include "tools/render_loop.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <memory>
#include <span>

#include "engine/diagnostics.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/video.h"
#include "scenes/frame_steps.h"
#include "scenes/frame_view.h"
#include "tools/open_context.h"
#include "tools/output_file.h"
#include "tools/stopwatch.h"
#include "tools/threads.h"

namespace tools {
namespace {

/// Frames in flight: one a stage, and one to even out their times.
constexpr std::size_t kTokens = 4;

/// Chosen: the error of a fixed step is sampled on at most this many frames of a run, which costs three frames each.
constexpr int kErrorSamples = 8;

struct FramePlan {
    int number = 0;
    double time = 0.0;  ///< s
    render::View view;
};

struct FramePicture {
    int number = 0;
    double time = 0.0;  ///< s
    render::Image image;
};

/// The four calls between a scene and its files, one method a stage.
class Run {
 public:
    explicit Run(const RenderJob& job)
        : job_(job),
          context_(openContext(job.backend, job.threads)),
          renderer_(context_, job.scene->size, job.quality),
          next_(job.frames.first),
          progress_(job.title, job.frames.last - job.frames.first + 1, job.talk) {
        result_.simulation = engine::start(job.scene->setup);
        result_.report.threads = job.threads;
        result_.report.glRenderer = context_.rendererName();
        if (!job.videoPath.empty()) video_ = std::make_unique<render::VideoWriter>(videoOptions(job));
    }

    FinishedRun all() {
        {
            const Stopwatch watch(result_.report.seconds.all);
            onThreads(job_.threads, [this] { runPipeline(); });
            if (video_ && result_.report.frames > 0) video_->finish();
        }
        result_.report.stateHash = engine::stateHash(result_.simulation.particles);
        return std::move(result_);
    }

 private:
    static render::VideoOptions videoOptions(const RenderJob& job) {
        render::VideoOptions options;
        options.path = job.videoPath;
        options.size = job.scene->size;
        options.fps = job.scene->fps;
        return options;
    }

    void runPipeline() {
        constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
        using PlanPointer = std::shared_ptr<FramePlan>;
        using PicturePointer = std::shared_ptr<FramePicture>;
        tbb::parallel_pipeline(kTokens, tbb::make_filter<void, PlanPointer>(
                                            kInOrder, [this](tbb::flow_control& flow) { return simulate(flow); }) &
                                            tbb::make_filter<PlanPointer, PicturePointer>(
                                                kInOrder, [this](const PlanPointer& plan) { return draw(*plan); }) &
                                            tbb::make_filter<PicturePointer, void>(
                                                kInOrder, [this](const PicturePointer& picture) { encode(*picture); }));
    }

    std::shared_ptr<FramePlan> simulate(tbb::flow_control& flow) {
        if (next_ > job_.frames.last) {
            flow.stop();
            return nullptr;
        }
        const Stopwatch watch(result_.report.seconds.simulating);
        auto plan = std::make_shared<FramePlan>();
        plan->number = next_++;
        plan->time = scenes::frameTime(*job_.scene, plan->number);
        try {
            scenes::advanceToFrame(*job_.scene, result_.simulation, plan->number);
            if ((plan->number - job_.frames.first) % sampleStride() == 0)
                addSample(result_.report.errors, *job_.scene, result_.simulation);
        } catch (const engine::InstabilityError& error) {
            // The frames before it are still on their way to their files.
            result_.report.unstable = error.what();
            flow.stop();
            return nullptr;
        }
        plan->view = scenes::frameView(*job_.scene, result_.simulation);
        return plan;
    }

    int sampleStride() const {
        const int count = job_.frames.last - job_.frames.first + 1;
        return (count + kErrorSamples - 1) / kErrorSamples;
    }

    std::shared_ptr<FramePicture> draw(const FramePlan& plan) {
        const Stopwatch watch(result_.report.seconds.drawing);
        auto picture = std::make_shared<FramePicture>(FramePicture{plan.number, plan.time, {}});
        // Isolated: a thread that waits for others here must not take up a frame's simulation and hold the context
        // meanwhile.
        tbb::this_task_arena::isolate([&] { picture->image = renderer_.draw(plan.view); });
        return picture;
    }

    void encode(const FramePicture& picture) {
        const Stopwatch watch(result_.report.seconds.encoding);
        if (const auto path = job_.pngPath(picture.number)) writeFile(*path, render::encodePng(picture.image));
        if (video_) video_->add(picture.image);
        ++result_.report.frames;
        progress_.frameDone(picture.number, picture.time);
    }

    const RenderJob& job_;
    render::Context context_;
    render::Renderer renderer_;
    std::unique_ptr<render::VideoWriter> video_;
    FinishedRun result_;
    int next_ = 0;
    Progress progress_;
};

}  // namespace

FinishedRun renderFrames(const RenderJob& job) {
    return Run(job).all();
}

}  // namespace tools
