// What the program says while it runs, and whether what it has said arrived.
#pragma once

#include <string>

namespace tools {

/// Writes to standard error, whether or not anybody takes it: nothing is lost but words.
void say(const std::string& text);

/// Throws render::SystemError when something that was printed to standard output could not be written.
void requirePrinted();

}  // namespace tools
