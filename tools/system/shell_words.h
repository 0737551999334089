// Command lines to copy.
#pragma once

#include <string>
#include <vector>

namespace tools {

/// The words as one line for a POSIX shell, quoted where they need it.
std::string shellLine(const std::vector<std::string>& words);

}  // namespace tools
