// Schedules of emitters, and the sites of a disc-shaped nozzle.
#include "engine/state/emitters.h"

#include <algorithm>
#include <cmath>

namespace engine {
namespace {

/// Relative tolerance with which sites exactly on the rim of a disc count as inside.
constexpr double kRimSlack = 1.0 + 1e-9;

}  // namespace

PlaneAxes axesAcross(const Vec3& direction) {
    const double length = std::sqrt(squaredLength(direction));
    if (length == 0.0) return {};
    const Vec3 unit = direction / length;
    // A coordinate axis that is far from parallel to the direction, so that the cross product is not small.
    const Vec3 axis = std::abs(unit.z()) < 0.7 ? Vec3::UnitZ() : Vec3::UnitX();
    Vec3 first = axis.cross(unit);
    first /= std::sqrt(squaredLength(first));
    return {first, unit.cross(first)};
}

double dueTime(const Emitter& emitter, const Schedule& schedule) {
    return schedule.origin + static_cast<double>(schedule.births) * emitter.interval;
}

std::vector<Vec3> discSites(const Vec3& center, const Vec3& direction, double radius, double spacing) {
    const PlaneAxes plane = axesAcross(direction);
    const double rowHeight = spacing * std::sqrt(0.75);
    const auto rows = static_cast<int>(std::floor(radius * kRimSlack / rowHeight));
    std::vector<Vec3> sites;
    for (int row = -rows; row <= rows; ++row) {
        const double across2 = row * rowHeight;
        const double shift = row % 2 == 0 ? 0.0 : 0.5 * spacing;
        const auto columns = static_cast<int>(std::floor(radius * kRimSlack / spacing)) + 1;
        for (int column = -columns; column <= columns; ++column) {
            const double across1 = column * spacing + shift;
            if (across1 * across1 + across2 * across2 > radius * radius * kRimSlack) continue;
            sites.push_back(center + across1 * plane.first + across2 * plane.second);
        }
    }
    return sites;
}

EmitterState initialState(const Emitter& emitter) {
    EmitterState state;
    state.schedules.resize(emitter.pick == Pick::all ? emitter.sites.size() : 1);
    for (Schedule& schedule : state.schedules) schedule.origin = schedule.due = emitter.start;
    return state;
}

bool isReachable(const Emitter& emitter, const EmitterState& state) {
    std::uint64_t births = 0;
    for (const Schedule& schedule : state.schedules) {
        const double undisturbed = dueTime(emitter, schedule);
        if (!std::isfinite(schedule.due) || schedule.origin < emitter.start - kSameMoment) return false;
        if (schedule.delayed ? schedule.due <= undisturbed : schedule.due != undisturbed) return false;
        births += schedule.births;
    }
    return births == state.births && births <= emitter.limit;
}

double nextEmission(const Emitter& emitter, const EmitterState& state) {
    double next = std::numeric_limits<double>::infinity();
    if (state.births >= emitter.limit) return next;
    for (const Schedule& schedule : state.schedules)
        if (schedule.due < emitter.until - kSameMoment) next = std::min(next, schedule.due);
    return next;
}

}  // namespace engine
