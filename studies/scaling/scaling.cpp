// From one state every method takes some steps, several times in turn.
#include "studies/scaling/scaling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_cache.h"
#include "studies/common/fcc_cube.h"
#include "studies/common/order_fit.h"
#include "studies/common/timing.h"

namespace studies {

const std::vector<PublishedRow> kTable2 = {{100, 2.3},    {1000, 11.9},  {1100, 21.7},  {1200, 124.5},
                                           {1300, 436.4}, {1400, 494.9}, {1500, 569.5}, {2000, 627.4}};

namespace {

using engine::ForceMethod;
using engine::Precision;
using engine::Simulation;

/// The paper's step, s.
constexpr double kStep = 0.01;

/// Of the packed blocks, s: the solid pulls itself together, which at the paper's step would throw it about.
constexpr double kBlockStep = 0.002;

/// Steps of a run from the same state. Chosen: a block's list is built twice on the way, whatever its size; after 20
/// some have had one only.
constexpr std::uint64_t kSteps = 22;
constexpr std::uint64_t kStepsOfEveryPair = 2;

/// The same state with nobody to be born, its forces summed another way.
Simulation frozen(const Simulation& from, ForceMethod method, Precision precision) {
    Simulation simulation = from;
    simulation.setup.emitters.clear();
    simulation.emitters.clear();
    simulation.cache->evaluator =
        engine::ForceEvaluator({from.setup.materials, from.setup.gravity, from.setup.obstacles}, method, precision);
    simulation.cache->forcesCurrent = false;
    return simulation;
}

void takeSteps(Simulation& simulation, std::uint64_t count) {
    const double start = simulation.time;
    for (std::uint64_t k = 1; k <= count; ++k)
        engine::advance(simulation, start + static_cast<double>(k) * simulation.setup.step);
}

/// Seconds of one step by one method: the mean over a run of some steps, run again until a round is long enough.
class Stopwatch {
 public:
    Stopwatch(const Simulation& from, ForceMethod method, Precision precision, const ScalingSettings& settings)
        : start_(frozen(from, method, precision)), steps_(method == ForceMethod::grid ? kSteps : kStepsOfEveryPair) {
        takeSteps(start_, 1);  // the list is built, the memory is there
        const double once = run();
        runs_ = std::max(1, static_cast<int>(std::ceil(settings.secondsPerRound / once)));
    }

    void measure() {
        double sum = 0.0;
        for (int k = 0; k < runs_; ++k) sum += run();
        rounds_.push_back(sum / runs_ / static_cast<double>(steps_));
    }

    double seconds() const { return median(rounds_); }
    const Simulation& end() const { return end_; }

 private:
    double run() {
        end_ = start_;
        return secondsOf([&] { takeSteps(end_, steps_); }, 1);
    }

    Simulation start_;
    Simulation end_;
    std::uint64_t steps_;
    int runs_ = 1;
    std::vector<double> rounds_;
};

ScalingRow measureFrom(const std::string& subject, const Simulation& from, const ScalingSettings& settings) {
    ScalingRow row;
    row.subject = subject;
    row.particles = from.particles.count();
    row.neighbors = meanNeighbors(from.setup, from.particles);
    std::vector<Stopwatch> watches;
    watches.emplace_back(from, ForceMethod::grid, Precision::doubles, settings);
    watches.emplace_back(from, ForceMethod::grid, Precision::singles, settings);
    if (row.particles <= settings.mostByEveryPair)
        watches.emplace_back(from, ForceMethod::reference, Precision::doubles, settings);
    for (int round = 0; round < settings.rounds; ++round)
        for (Stopwatch& watch : watches) watch.measure();
    row.list = watches[0].seconds();
    row.listInFloat = watches[1].seconds();
    if (watches.size() > 2) row.everyPair = watches[2].seconds();
    row.stateHash = engine::stateHash(watches[0].end().particles);
    return row;
}

void addFit(std::vector<ScalingFit>& fits, const std::string& subject, const std::string& method,
            const std::vector<StepError>& points) {
    const std::optional<double> exponent = fittedOrder(points);  // a slope of logarithms, whatever they are of
    if (!exponent) return;
    const auto size = [](double particles) { return static_cast<std::size_t>(particles); };
    fits.push_back({subject, method, size(points.front().step), size(points.back().step), *exponent});
}

/// Where a method's time has become a power of the number: every pair soon, lists once caches no longer hold them.
constexpr std::size_t kPairsFrom = 1000;
constexpr std::size_t kListsFrom = 10000;

}  // namespace

std::vector<ScalingRow> measureScene(const std::string& name, const scenes::Scene& scene,
                                     const ScalingSettings& settings, const ScalingListener& listener) {
    engine::Setup setup = scene.setup;
    setup.stepper = engine::StepperKind::symplecticEuler;
    setup.step = kStep;
    for (engine::Emitter& emitter : setup.emitters) {
        emitter.limit = std::numeric_limits<std::uint64_t>::max();
        emitter.until = std::numeric_limits<double>::infinity();
    }
    std::vector<ScalingRow> rows;
    Simulation simulation = engine::start(setup);
    for (const PublishedRow& published : kTable2) {
        if (published.particles > settings.mostInScenes) break;
        while (simulation.particles.count() < published.particles) takeSteps(simulation, 1);
        ScalingRow row = measureFrom(name, simulation, settings);
        row.published = 1e-3 * published.milliseconds;
        listener(row);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<ScalingRow> measureCubes(const std::string& material, const ScalingSettings& settings,
                                     const ScalingListener& listener) {
    std::vector<ScalingRow> rows;
    for (const std::size_t count : settings.cubeSizes) {
        engine::Setup setup = fccCube(material, count, {.mass = 1.0, .speed = 1.0});
        setup.stepper = engine::StepperKind::symplecticEuler;
        setup.step = kBlockStep;
        rows.push_back(measureFrom(material, engine::start(setup), settings));
        listener(rows.back());
    }
    return rows;
}

std::vector<ScalingFit> fitsOf(const std::vector<ScalingRow>& rows) {
    std::vector<ScalingFit> fits;
    std::vector<StepError> everyPair;
    std::vector<StepError> list;
    std::vector<StepError> inFloat;
    for (const ScalingRow& row : rows) {
        const auto particles = static_cast<double>(row.particles);
        if (row.everyPair && row.particles >= kPairsFrom) everyPair.push_back({particles, *row.everyPair});
        if (row.particles < kListsFrom) continue;
        list.push_back({particles, row.list});
        inFloat.push_back({particles, row.listInFloat});
    }
    const std::string subject = rows.empty() ? "" : rows.front().subject;
    addFit(fits, subject, "every pair", everyPair);
    addFit(fits, subject, "list", list);
    addFit(fits, subject, "list in float", inFloat);
    return fits;
}

}  // namespace studies
