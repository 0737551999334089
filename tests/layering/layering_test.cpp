// The arrows between folders: every #include line of the sources is read, and one that points the wrong way fails by
// name.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>
#include "tests/catch.h"

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kFolders = {"engine", "render", "scenes", "studies", "tools", "tests"};

/// Which of our folders a folder may include, itself left out.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"engine", {}},
    {"render", {}},
    {"scenes", {"engine"}},
    {"studies", {"engine", "render", "scenes"}},
    {"tools", {"engine", "render", "scenes", "studies"}},
    {"tests", {"engine", "render", "scenes", "studies", "tools"}}};

/// The one header of another folder that is allowed by name.
const std::set<std::pair<std::string, std::string>> kAllowedFiles = {{"scenes", "render/view.h"}};

/// Libraries that a folder may use, by the first part of the path; standard headers have no such part.
const std::map<std::string, std::set<std::string>> kLibraries = {
    {"engine", {"Eigen", "hwy", "tbb"}},
    {"scenes", {"Eigen", "glm", "fmt", "toml++"}},
    {"studies", {"Eigen", "fmt", "glm", "hwy", "tbb"}},
};

/// Standard headers that a folder must not use: files, clocks, environment, output.
const std::map<std::string, std::set<std::string>> kForbiddenHeaders = {
    {"engine", {"fstream", "iostream", "filesystem", "chrono", "ctime", "cstdio", "cstdlib", "random", "thread"}},
    {"scenes", {"iostream", "chrono", "ctime", "cstdio", "thread"}},
    {"studies", {"fstream", "iostream", "filesystem", "cstdio", "cstdlib", "random", "thread"}},
    {"render", {"iostream"}}};

/// Standard headers that one file may use all the same: ThreadSanitizer sees these threads, and oneTBB's not.
const std::set<std::pair<std::string, std::string>> kAllowedHeaders = {{"engine/parallel.h", "thread"}};

struct Include {
    std::string folder;  ///< of the file that includes
    std::string file;
    int line = 0;
    std::string target;
};

std::vector<Include> includesIn(const std::string& folder, const std::string& file, std::istream& stream) {
    static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
    std::vector<Include> found;
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
        std::smatch match;
        if (std::regex_search(text, match, pattern)) found.push_back({folder, file, line, match[1]});
    }
    return found;
}

std::vector<Include> allIncludes() {
    std::vector<Include> found;
    for (const std::string& folder : kFolders)
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLOBULAR_SOURCE) / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream stream(entry.path());
            const auto here = includesIn(folder, fs::relative(entry.path(), GLOBULAR_SOURCE).string(), stream);
            found.insert(found.end(), here.begin(), here.end());
        }
    return found;
}

/// Why an include is wrong; empty if it is not.
std::string verdict(const Include& include) {
    const std::string target = include.target.substr(0, include.target.find('/'));
    if (kFolders.count(target) == 1 && target != include.folder && kAllowed.at(include.folder).count(target) == 0 &&
        kAllowedFiles.count({include.folder, include.target}) == 0)
        return include.folder + "/ must not include " + target + "/";
    if (include.target.find("..") != std::string::npos) return "paths start at the root, not at ..";
    const std::string refusal = include.folder + "/ must not include <" + include.target + ">";
    if (const auto libraries = kLibraries.find(include.folder); libraries != kLibraries.end()) {
        // Without a slash and with .h: the system's C headers.
        const bool isLibrary = include.target.find('/') != std::string::npos;
        if (isLibrary ? kFolders.count(target) == 0 && libraries->second.count(target) == 0
                      : include.target.find('.') != std::string::npos)
            return refusal;
    }
    const auto forbidden = kForbiddenHeaders.find(include.folder);
    if (forbidden != kForbiddenHeaders.end() && forbidden->second.count(include.target) == 1 &&
        kAllowedHeaders.count({include.file, include.target}) == 0)
        return refusal;
    return "";
}

}  // namespace

TEST_CASE("Every include follows the arrows between folders", "[layering]") {
    const auto includes = allIncludes();
    REQUIRE(includes.size() > 200);  // the sources were found
    for (const Include& include : includes) {
        INFO(include.file << ":" << include.line << ": " << include.target);
        CHECK(verdict(include) == "");
    }
}

TEST_CASE("A wrong arrow is noticed", "[layering]") {
    CHECK(verdict({"engine", "engine/x.cpp", 1, "scenes/scene.h"}) != "");
    CHECK(verdict({"render", "render/x.cpp", 1, "engine/vec3.h"}) != "");
    CHECK(verdict({"scenes", "scenes/x.cpp", 1, "render/context.h"}) != "");
    CHECK(verdict({"scenes", "scenes/x.cpp", 1, "render/view.h"}) == "");
    CHECK(verdict({"engine", "engine/x.cpp", 1, "chrono"}) != "");
    CHECK(verdict({"engine", "engine/x.cpp", 1, "unistd.h"}) != "");
    CHECK(verdict({"engine", "engine/x.cpp", 1, "glm/vec3.hpp"}) != "");
    CHECK(verdict({"engine", "engine/x.cpp", 1, "Eigen/Geometry"}) == "");
    CHECK(verdict({"render", "render/x.cpp", 1, "../scenes/scene.h"}) != "");
    CHECK(verdict({"studies", "studies/x.cpp", 1, "tools/html.h"}) != "");
    CHECK(verdict({"studies", "studies/x.cpp", 1, "fstream"}) != "");
    CHECK(verdict({"studies", "studies/x.cpp", 1, "chrono"}) == "");
    CHECK(verdict({"scenes", "scenes/x.cpp", 1, "studies/accuracy.h"}) != "");
    CHECK(verdict({"tools", "tools/x.cpp", 1, "tests/engine/clouds.h"}) != "");
}
