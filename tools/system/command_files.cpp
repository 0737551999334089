// Inputs are told from outputs by device and inode, files that do not exist yet by folder and name.
#include "tools/system/command_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <fstream>
#include <set>

#include "scenes/text/input_error.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// The path without links and dots. The file need not exist.
std::string realPath(const fs::path& path) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
    return (real.has_filename() ? real : real.parent_path()).string();
}

/// A text that is the same for two paths if they lead to the same file.
std::string identityOf(const fs::path& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return realPath(path);
    return fmt::format("{}:{}", status.st_dev, status.st_ino);
}

/// The files in a folder, which need not exist.
std::vector<fs::path> existingFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
        files.push_back(file->path());
    return files;
}

/// The problems of the outputs, each named by its flag and path.
class OutputCheck {
 public:
    explicit OutputCheck(const CommandFiles& files) : files_(files) {
        for (const fs::path& input : files.inputs) inputs_.insert(identityOf(input));
    }

    std::vector<scenes::Problem> problems() {
        for (const OutputFile& output : files_.outputs) checkFile(output);
        for (const OutputFolder& folder : files_.folders) checkFolder(folder);
        return std::move(problems_);
    }

 private:
    template <class Output>
    void add(const Output& output, const std::string& message) {
        problems_.push_back({fmt::format("{} {}", output.flag, output.path.string()), 0, 0, message});
    }

    void checkFile(const OutputFile& output) {
        if (output.path == "-") return add(output, "cannot be standard output; a file of this name is ./-");
        if (inputs_.count(identityOf(output.path)) != 0)
            return add(output, "this file is read by the same command and would be lost");
        // Two names of one file are no conflict here, because each becomes a file of its own.
        if (!outputs_.insert(realPath(output.path)).second)
            add(output, "another output of the command has the same name");
        const std::string folderOfOutput = identityOf(output.path.has_parent_path() ? output.path.parent_path() : ".");
        for (const OutputFolder& folder : files_.folders)
            if (identityOf(folder.path) == folderOfOutput && folder.isWritten(output.path))
                add(output, fmt::format("{} {} writes a file of this name", folder.flag, folder.path.string()));
    }

    void checkFolder(const OutputFolder& folder) {
        if (folder.path == "-") return add(folder, "cannot be standard output; a folder of this name is ./-");
        std::error_code ignored;
        if (!fs::is_directory(folder.path, ignored) && inputs_.count(identityOf(folder.path)) != 0)
            return add(folder, "this file is read by the same command, a folder is wanted");
        const fs::path page = folder.path / "index.html";
        if (folder.isWritten(page) && fs::exists(page, ignored) && !isOwnPage(page))
            add(folder, "index.html in it was not written by globular; choose another folder or remove it");
        for (const fs::path& file : existingFiles(folder.path))
            if (folder.isWritten(file) && inputs_.count(identityOf(file)) != 0)
                add(folder,
                    fmt::format("{} in it is read by the same command and would be lost", file.filename().string()));
    }

    const CommandFiles& files_;
    std::set<std::string> inputs_;   ///< identities
    std::set<std::string> outputs_;  ///< real paths
    std::vector<scenes::Problem> problems_;
};

}  // namespace

bool isOwnPage(const fs::path& file) {
    std::string head(1024, '\0');  // the title is among the first lines
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("<title>globular") != std::string::npos || head.find("<title>Globular") != std::string::npos;
}

void requireSeparate(const CommandFiles& files) {
    const std::vector<scenes::Problem> problems = OutputCheck(files).problems();
    if (!problems.empty()) throw scenes::InputError(problems);
}

}  // namespace tools
