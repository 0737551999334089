// What the program says while it runs, and whether what it has said arrived.
#pragma once

#include <string>

namespace tools {

/// Opens those of the three standard streams that are closed, so that no file that is opened later becomes one of them;
/// writing to them stays an error. A reader that goes away is an error from now on, and no signal: it must not end a
/// run halfway.
void prepareStandardStreams();

/// Writes to standard error, whether or not anybody takes it: nothing is lost but words.
void printToStderr(const std::string& text);

/// Throws render::SystemError when something that was printed to standard output could not be written; ExitStatus,
/// without a word and with the code that shells give a program whose reader went away, when that is why.
void flushStandardOutput();

}  // namespace tools
