// Collects the problems of a scene while it is read, so that all of them are reported at once; likewise its warnings.
#pragma once

#include <string>
#include <vector>

#include "scenes/text/input_error.h"
#include "scenes/text/override.h"
#include "scenes/text/value.h"

namespace scenes {

class ProblemList {
 public:
    /// @param file  the scene file, named in the message of each problem
    /// @param overrides  overrides of the command line; a problem in one of them names its option instead of the file
    ProblemList(std::string file, Overrides overrides);

    /// Records a problem. The same message at the same position is recorded once.
    void add(const SourcePosition& position, std::string message);

    /// Records the problems of a file that the scene refers to, at the position of the reference.
    void add(const SourcePosition& position, const InputError& error);

    bool empty() const { return items_.empty(); }

    /// All problems: those of the file by position, then those of the overrides in order.
    std::vector<Problem> sorted() const;

    /// Throws an InputError with all problems.
    void throwIfAny() const;

 private:
    struct Item {
        SourcePosition position;
        std::string message;
    };

    std::string file_;
    Overrides overrides_;
    std::vector<Item> items_;
    bool isTruncated_ = false;
};

}  // namespace scenes
