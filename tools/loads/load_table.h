// loads.csv: what the particles do to the recorded obstacles over time, one row for each interval between two frames
// and obstacle. Filled in by the frames of a run, and read by `globular plot`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"
#include "tools/system/json.h"

namespace tools {

/// The first line of the file, with its line break, which says what the columns are. Force and torque are means over
/// the interval that ends at the time; impulse and work are since the start. Force, torque and impulse are what the
/// particles do to the obstacle, with the torque about its pivot; the work is what the obstacle does on the particles.
inline constexpr std::string_view kLoadsHead =
    "time_s,obstacle,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm,"
    "impulse_x_Ns,impulse_y_Ns,impulse_z_Ns,work_J\n";

/// The loads of the recorded obstacles at the present state as JSON, for run.json: an object for each of them.
Json loadsJson(const scenes::Scene& scene, const engine::Simulation& simulation);

/// The file's text as it grows with a run.
class LoadTable {
 public:
    LoadTable() = default;

    /// @param simulation  at the start of a run, or at the frame up to which the text goes
    /// @param text        text() at that frame; empty at the start of a run
    explicit LoadTable(const engine::Simulation& simulation, std::string text = "");

    /// Adds the rows of an interval.
    /// @param simulation  at the end of the interval
    /// @param time        that end, s
    /// @param seconds     length of the interval, s
    void add(const engine::Simulation& simulation, double time, double seconds);

    /// Empty if no loads are recorded.
    const std::string& text() const { return text_; }

 private:
    std::vector<engine::ObstacleLoad> before_;  ///< of the obstacles at the end of the last row
    std::string text_;
};

}  // namespace tools
