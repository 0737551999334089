// Runs the program as a user would and keeps its output.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace program {

namespace fs = std::filesystem;

struct Outcome {
    int code = -1;
    std::string out;
    std::string err;
};

/// Writes a file, and makes its folder where there is none.
inline void writeText(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string textOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A new temporary folder that is removed with the object.
class Folder {
 public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "globular-test-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { fs::remove_all(path_); }

    fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
    fs::path path_;
};

/// The exit code of a program that a sanitizer stopped. The program itself never ends with it.
inline constexpr int kSanitizerExit = 99;

/// Runs a line in a shell. Reports of the sanitizers, such as findings or a warning that one of their tools is missing,
/// are not in `err`; they go to the standard error of the test suite.
inline Outcome shell(const std::string& line) {
    const Folder folder;
    const std::string reports = (folder / "sanitizer").string();
    std::string command;
    for (const std::string name : {"ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"})
        command += "export " + name + "=\"${" + name + ":+$" + name + ":}exitcode=" + std::to_string(kSanitizerExit) +
                   ":log_path=" + reports + "\"; ";
    command += "{ " + line + "; } >" + (folder / "out").string() + " 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    for (const fs::directory_entry& file : fs::directory_iterator(folder / ""))
        if (file.path().stem() == "sanitizer") std::cerr << textOf(file.path());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(folder / "out"), textOf(folder / "err")};
}

/// Runs the program.
/// @param arguments  as typed in a shell
/// @param environment  assignments to put before the program's name
inline Outcome run(const std::string& arguments, const std::string& environment = "") {
    return shell(environment + " " GLOBULAR_PROGRAM " " + arguments);
}

inline long lineCount(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

}  // namespace program
