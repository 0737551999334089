// Overrides: changes to a scene that the command line (--set and shorthands such as --size) or a study asks for.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scenes {

/// An assignment to a key of a scene, and the command-line option that it comes from, which messages about problems
/// name.
struct Override {
    std::string assignment;  ///< "physics.step=0.005"
    std::string option;      ///< the option as typed: "--set physics.step=0.005"

    /// An override given by --set. Implicit, so that a list of overrides can be written as a list of strings.
    Override(std::string text) : assignment(std::move(text)), option("--set " + assignment) {}
    Override(const char* text) : Override(std::string(text)) {}

    /// An override given by another option than --set.
    Override(std::string text, std::string givenBy) : assignment(std::move(text)), option(std::move(givenBy)) {}

    bool operator==(const Override& other) const = default;
};

using Overrides = std::vector<Override>;

}  // namespace scenes
