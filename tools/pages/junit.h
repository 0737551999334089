// The results of `compare` in JUnit's XML format, which CI systems show as tests.
#pragma once

#include <string>

#include "tools/compare/compare_pictures.h"

namespace tools {

/// Collects results; text() is the content of the file.
class JunitReport {
 public:
    void add(const PictureResult& result);
    std::string text(const CompareCounts& counts) const;

 private:
    std::string cases_;
};

}  // namespace tools
