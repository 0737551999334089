// Collects the problems of one scene while it is read, so that all of them are reported at once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/text/input_error.h"
#include "scenes/text/located.h"
#include "scenes/text/override.h"

namespace scenes {

class ProblemList {
 public:
    /// Problems will name this file, or the flag of the override they are in.
    ProblemList(std::string file, Overrides overrides);

    /// Records a problem; one already recorded at the same place in the same words is not repeated.
    void add(const Position& at, std::string message);

    /// Records what another file's reader found, at the place that names that file.
    void add(const Position& at, const InputError& error);

    bool empty() const { return entries_.empty(); }

    /// Throws an InputError with all problems: those of the file by position, then those of the overrides in their
    /// order.
    void throwIfAny() const;

 private:
    struct Located {
        Position at;
        std::string message;
    };

    std::string file_;
    Overrides overrides_;
    std::vector<Located> entries_;
    bool more_ = false;
};

}  // namespace scenes
