// A change to a scene that whoever runs it asks for.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scenes {

/// A key and its value, and the flag that says so, which problems name.
struct Override {
    std::string change;  ///< "physics.step=0.005"
    std::string flag;    ///< "--set physics.step=0.005"

    /// Of --set. Not explicit: most changes are written down as such.
    Override(std::string keyAndValue) : change(std::move(keyAndValue)), flag("--set " + change) {}
    Override(const char* keyAndValue) : Override(std::string(keyAndValue)) {}

    /// Of another flag.
    Override(std::string keyAndValue, std::string of) : change(std::move(keyAndValue)), flag(std::move(of)) {}

    bool operator==(const Override& other) const = default;
};

using Overrides = std::vector<Override>;

}  // namespace scenes
