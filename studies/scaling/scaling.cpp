// Measures the time of a step against the number of particles: every method takes the same steps from the same state,
// in rounds by turns. Writes the tables and the plot as text. See scaling.h.
#include "studies/scaling/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_cache.h"
#include "studies/common/fcc_cube.h"
#include "studies/common/power_law.h"
#include "studies/common/report.h"
#include "studies/common/timing.h"

namespace studies {
namespace {

using engine::ForceMethod;
using engine::Precision;
using engine::Simulation;

/// A row of the paper's Table 2: time per frame of the paper's program, which takes one step per frame.
struct PublishedRow {
    std::size_t particles = 0;
    double milliseconds = 0.0;
};

/// Table 2 of Cote 2024, measured on a GeForce RTX 4080 and a Ryzen 7 at 3.4 GHz.
constexpr PublishedRow kTable2[] = {{100, 2.3},    {1000, 11.9},  {1100, 21.7},  {1200, 124.5},
                                    {1300, 436.4}, {1400, 494.9}, {1500, 569.5}, {2000, 627.4}};

/// The paper's time step, s.
constexpr double kStep = 0.01;

/// The time step in cubes, s. Chosen: the contraction of the solid would be unstable at the paper's step.
constexpr double kCubeStep = 0.002;

/// Number of steps of a run, with neighbor lists and for the method that visits every pair. Chosen: with 22 steps a
/// cube of any size rebuilds its list twice; with 20 some rebuild it only once.
constexpr std::uint64_t kRunSteps = 22;
constexpr std::uint64_t kRunStepsOfEveryPair = 2;

/// The state of a simulation without further births and with forces by another method.
Simulation frozen(const Simulation& from, ForceMethod method, Precision precision) {
    Simulation simulation = from;
    simulation.setup.emitters.clear();
    simulation.emitters.clear();
    simulation.cache->evaluator = engine::ForceEvaluator(forceFieldOf(from.setup), method, precision);
    simulation.cache->forcesCurrent = false;
    return simulation;
}

void takeSteps(Simulation& simulation, std::uint64_t count) {
    const double start = simulation.time;
    for (std::uint64_t k = 1; k <= count; ++k)
        engine::advance(simulation, start + static_cast<double>(k) * simulation.setup.step);
}

/// Times one method of computing forces. A round repeats a run of some steps from the same state until the round has
/// taken long enough for the clock.
class MethodTimer {
 public:
    MethodTimer(const Simulation& from, ForceMethod method, Precision precision, const ScalingSettings& settings)
        : start_(frozen(from, method, precision)),
          steps_(method == ForceMethod::grid ? kRunSteps : kRunStepsOfEveryPair) {
        takeSteps(start_, 1);  // builds the neighbor list and allocates memory
        const double once = run();
        runCount_ = std::max(1, static_cast<int>(std::ceil(settings.secondsPerRound / once)));
    }

    /// Times one round: so many runs of the same steps that they take long enough for the clock.
    void measure() {
        double sum = 0.0;
        for (int k = 0; k < runCount_; ++k) sum += run();
        rounds_.push_back(sum / runCount_ / static_cast<double>(steps_));
    }

    /// Median of the time per step over the rounds, s.
    double seconds() const { return median(rounds_); }
    const Simulation& end() const { return end_; }

 private:
    double run() {
        end_ = start_;
        return secondsOf([&] { takeSteps(end_, steps_); });
    }

    Simulation start_;
    Simulation end_;
    std::uint64_t steps_;
    int runCount_ = 1;
    std::vector<double> rounds_;
};

ScalingRow measureFrom(const std::string& subject, const Simulation& from, const ScalingSettings& settings) {
    ScalingRow row;
    row.subject = subject;
    row.particles = from.particles.count();
    row.neighbors = meanNeighbors(from.setup, from.particles);
    std::vector<MethodTimer> timers;
    timers.emplace_back(from, ForceMethod::grid, Precision::doubles, settings);
    timers.emplace_back(from, ForceMethod::grid, Precision::singles, settings);
    if (row.particles <= settings.mostByEveryPair)
        timers.emplace_back(from, ForceMethod::reference, Precision::doubles, settings);
    for (int round = 0; round < settings.rounds; ++round)
        for (MethodTimer& timer : timers) timer.measure();
    row.list = timers[0].seconds();
    row.listInFloat = timers[1].seconds();
    if (timers.size() > 2) row.everyPair = timers[2].seconds();
    row.stateHash = engine::stateHash(timers[0].end().particles);
    return row;
}

/// The smallest numbers of particles that power laws are fitted from, for the method that visits every pair and for
/// neighbor lists. Chosen: from these numbers on the times are powers of the number of particles, because the work per
/// step outweighs constant costs, and lists no longer fit the caches.
constexpr std::size_t kPairsFrom = 1000;
constexpr std::size_t kListsFrom = 10000;

std::optional<double> milliseconds(const std::optional<double>& seconds) {
    return seconds ? std::optional(1e3 * *seconds) : std::nullopt;
}

constexpr const char* kAxes = R"(set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "particles"
set ylabel "milliseconds a step"
set title "Time per step against the number of particles"
set key top left reverse Left samplen 2 font ",13"
)";

/// Adds the number of particles and the milliseconds per step to a curve, if there is a time.
void addPoint(Curve& curve, const ScalingRow& row, const std::optional<double>& seconds) {
    if (seconds) curve.points += fmt::format("{} {:.6g}\n", row.particles, 1e3 * *seconds);
}

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
        setup.step = kCubeStep;
        rows.push_back(measureFrom(material, engine::start(setup), settings));
        listener(rows.back());
    }
    return rows;
}

std::vector<ScalingFit> fitsOf(const std::vector<ScalingRow>& rows) {
    std::vector<ScalingFit> fits;
    const auto addFit = [&](const char* method, std::size_t from, auto time) {
        std::vector<PowerLawPoint> points;
        for (const ScalingRow& row : rows)
            if (const std::optional<double> seconds = row.*time; seconds && row.particles >= from)
                points.push_back({static_cast<double>(row.particles), *seconds});
        const std::optional<double> exponent = powerLawExponent(points);
        if (!exponent) return;
        const auto size = [](const PowerLawPoint& point) { return static_cast<std::size_t>(point.x); };
        fits.push_back({rows.front().subject, method, size(points.front()), size(points.back()), *exponent});
    };
    addFit("every pair", kPairsFrom, &ScalingRow::everyPair);
    addFit("list", kListsFrom, &ScalingRow::list);
    addFit("list in float", kListsFrom, &ScalingRow::listInFloat);
    return fits;
}

std::string scalingCsv(const std::vector<ScalingRow>& rows) {
    std::string csv = "subject,particles,neighbors,published_ms,every_pair_ms,list_ms,list_in_float_ms,state_hash\n";
    for (const ScalingRow& row : rows)
        csv += csvFields(row.subject, row.particles, row.neighbors, milliseconds(row.published),
                         milliseconds(row.everyPair), milliseconds(row.list), milliseconds(row.listInFloat),
                         row.stateHash) +
               "\n";
    return csv;
}

std::string fitsCsv(const std::vector<ScalingFit>& fits) {
    std::string csv = "subject,method,from,to,exponent\n";
    for (const ScalingFit& fit : fits) csv += csvFields(fit.subject, fit.method, fit.from, fit.to, fit.exponent) + "\n";
    return csv;
}

std::string scalingPlot(const std::vector<ScalingRow>& rows) {
    Curve published{"Table 2 (the paper's machine)", "lines linewidth 2 linecolor rgb '#7f7f7f' dashtype 2"};
    Curve everyPair{"every pair, here", "linespoints pointtype 5 pointsize 0.7 linecolor rgb '#d62728'"};
    Curve list{"neighbor lists", "linespoints pointtype 7 pointsize 0.8 linecolor rgb '#0072b2'"};
    Curve inFloat{"neighbor lists in float", "linespoints pointtype 6 pointsize 1 linecolor rgb '#56b4e9'"};
    std::string subject;
    for (const ScalingRow& row : rows) {
        // An empty line interrupts the curve between two scenes or materials.
        if (!subject.empty() && row.subject != subject)
            for (Curve* curve : {&everyPair, &list, &inFloat}) curve->points += "\n";
        subject = row.subject;
        if (row.published && row.subject == rows.front().subject) addPoint(published, row, row.published);
        addPoint(everyPair, row, row.everyPair);
        addPoint(list, row, row.list);
        addPoint(inFloat, row, row.listInFloat);
    }
    return plotScript(kAxes, {published, everyPair, list, inFloat});
}

}  // namespace studies
