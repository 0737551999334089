// The rows of the schema by subject, and the bounds they share. Included by the schema's own files only.
#pragma once

#include "scenes/schema/schema.h"

namespace scenes {

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();
inline constexpr Range kPositive{.low = 0.0, .high = kNoBound, .lowOpen = true};
inline constexpr Range kNotNegative{.low = 0.0};
inline constexpr Range kUnitInterval{.low = 0.0, .high = 1.0};
/// Beyond it a run counts a particle as lost, m; nothing sane is faster than that either, m/s.
inline constexpr Range kWithinWorld{.low = -1e8, .high = 1e8};

/// Title, timing, physics and materials.
std::vector<Key> worldRows();

/// Bodies, emitters and obstacles.
std::vector<Key> contentRows();

/// Camera, look, overlay and still.
std::vector<Key> pictureRows();

/// The hard cases' own table.
std::vector<Key> studyRows();

}  // namespace scenes
