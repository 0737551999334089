// The keys of each table of a scene file, and the ranges that they share. Included by the schema*.cpp and keys_*.cpp
// files only.
#pragma once

#include "engine/state/state_checks.h"
#include "scenes/schema/schema.h"

namespace scenes {

inline constexpr Range kPositive{.low = 0.0, .isLowExcluded = true};
inline constexpr Range kNotNegative{.low = 0.0};
inline constexpr Range kUnitInterval{.low = 0.0, .high = 1.0};
inline constexpr Range kOpenUnitInterval{.low = 0.0, .high = 1.0, .isLowExcluded = true, .isHighExcluded = true};
/// Range of coordinates (m): a particle further out counts as lost. It also serves for velocities (m/s), which have no
/// tighter bound.
inline constexpr Range kWithinWorld{.low = -engine::kWorldLimit, .high = engine::kWorldLimit};

inline constexpr Range kRadii{.low = engine::kLeastRadius, .high = engine::kLargestRadius};  ///< of particles, m
inline constexpr Range kMasses{.low = engine::kLeastMass, .high = engine::kLargestMass};     ///< of particles, kg

/// A key of a scene file, to which range, default and so on are added by its member functions.
inline Key key(std::string_view name, Type type, std::string_view unit, std::string_view help) {
    return {.name = name, .type = type, .unit = unit, .help = help};
}

/// A key whose value is a point in space.
inline Key position(std::string_view name, std::string_view help) {
    return key(name, Type::vec3, "m", help).within(kWithinWorld);
}

inline Key velocity(std::string_view name, std::string_view help) {
    return key(name, Type::vec3, "m/s", help).within(kWithinWorld);
}

inline Key length(std::string_view name, std::string_view help) {
    return key(name, Type::number, "m", help).within({.low = 0.0, .high = engine::kWorldLimit, .isLowExcluded = true});
}

/// A key whose value is a number from 0 to 1.
inline Key share(std::string_view name, std::string_view help) {
    return key(name, Type::number, "", help).within(kUnitInterval);
}

/// A key whose value is an absolute temperature.
inline Key temperature(std::string_view name, std::string_view help) {
    return key(name, Type::number, "K", help).within({.low = 0.0, .high = 1e5});
}

/// Keys of the inside of a transparent body, render::Medium.
inline Key refractiveIndexKey() {
    return key("refractive_index", Type::number, "",
               "refractive index of what is transparent: 1.33 for water, 1.5 for glass and honey")
        .within({1.0, 4.0});
}

inline Key attenuationKey() {
    return length("attenuation_distance", "way through what is transparent on which white light takes its color")
        .defaultsTo("1");
}

inline Key color(std::string_view name, std::string_view help) {
    return key(name, Type::color, "", help).within(kUnitInterval);
}

std::vector<Key> topKeys();
std::vector<Key> physicsKeys();
std::vector<Key> worldKeys();
std::vector<Key> airKeys();
std::vector<Key> materialKeys();
std::vector<Key> bodyKeys();
std::vector<Key> emitterKeys();
std::vector<Key> emitterPathKeys();
std::vector<Key> obstacleKeys();
std::vector<Key> obstaclePathKeys();
std::vector<Key> fieldKeys();
std::vector<Key> cameraKeys();
std::vector<Key> lookKeys();
std::vector<Key> overlayKeys();
std::vector<Key> stillKeys();
std::vector<Key> studyKeys();

}  // namespace scenes
