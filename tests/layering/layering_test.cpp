// The layout of the sources: every #include line is read, and one that points from a lower folder or room to a higher
// one fails by name. A folder is a library, a room is a sub-folder of one.
#include <algorithm>
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

const std::set<std::string> kFolders = {"engine", "render", "scenes", "studies", "tools", "mpi", "tests"};

/// Which of our folders a folder may include, itself left out.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"engine", {}},
    {"render", {}},
    {"scenes", {"engine"}},
    {"studies", {"engine", "render", "scenes"}},
    {"tools", {"engine", "render", "scenes", "studies"}},
    {"mpi", {"engine", "scenes", "tools"}},
    {"tests", {"engine", "render", "scenes", "studies", "tools"}}};

/// Headers of another folder that are allowed by name: plain data.
const std::set<std::pair<std::string, std::string>> kAllowedFiles = {{"scenes", "render/picture/view.h"},
                                                                     {"scenes", "render/overlay/built_in_font.h"}};

/// Headers without a folder that single files may use: libraries of one file, and what loads modules.
const std::set<std::pair<std::string, std::string>> kPlainHeaders = {
    {"scenes/shapes/image_outline.cpp", "stb_image.h"},
    {"scenes/shapes/mesh_distances.cpp", "dlfcn.h"},
    {"scenes/shapes/mesh_file.cpp", "dlfcn.h"},
    {"scenes/shapes/text_outline.cpp", "stb_truetype.h"}};

/// Libraries that a folder may use, by the first part of the path; standard headers have no such part.
const std::map<std::string, std::set<std::string>> kLibraries = {
    {"engine", {"Eigen", "hwy", "tbb"}},
    {"scenes", {"Eigen", "glm", "fmt", "nlohmann", "toml++"}},
    {"studies", {"Eigen", "fmt", "glm", "hwy", "tbb"}},
};

/// Standard headers that a folder must not use: files, clocks, environment, output.
const std::map<std::string, std::set<std::string>> kForbiddenHeaders = {
    {"engine", {"fstream", "iostream", "filesystem", "chrono", "ctime", "cstdio", "cstdlib", "random", "thread"}},
    {"scenes", {"iostream", "chrono", "ctime", "cstdio", "thread"}},
    {"studies", {"fstream", "iostream", "filesystem", "cstdio", "cstdlib", "random", "thread"}},
    {"render", {"iostream"}}};

/// The rooms of each folder, from the top down: a room may include those after it in its own list alone. The folder
/// itself stands for the files that lie in no room.
const std::map<std::string, std::vector<std::string>> kRooms = {
    {"engine",
     {"engine/run", "engine/error_control", "engine/heat", "engine/stepping", "engine/forces", "engine/neighbors",
      "engine/state", "engine/ranks", "engine/obstacles", "engine/shapes", "engine/force_law", "engine/core"}},
    {"render",
     {"render",
      "render/opengl",
      "render/opengl/objects",
      "render/opengl/context",
      "render/cpu",
      "render/cpu/transparency",
      "render/cpu/shading",
      "render/cpu/lighting",
      "render/cpu/metaballs",
      "render/cpu/raster",
      "render/mesh",
      "render/prepare",
      "render/prepare/rays",
      "render/prepare/lighting",
      "render/prepare/skin",
      "render/prepare/cells",
      "render/overlay",
      "render/output",
      "render/compare",
      "render/picture"}},
    {"scenes",
     {"scenes/view", "scenes/build", "scenes/warnings", "scenes/schema", "scenes/model", "scenes/shapes",
      "scenes/particles", "scenes/text"}},
    {"studies",
     {"studies/accuracy", "studies/stability", "studies/scaling", "studies/bench", "studies/meshes", "studies/pictures",
      "studies/oracle", "studies/common"}},
    {"tools",
     {"tools", "tools/commands/study", "tools/commands", "tools/pages", "tools/compare", "tools/mesh", "tools/run",
      "tools/loads", "tools/frames", "tools/system"}},
    {"mpi", {"mpi"}}};

/// The layout shows the architecture only as long as a room fits on a screen.
constexpr std::size_t kMostFilesInRoom = 25;

std::string roomOf(const std::string& file) {
    return file.substr(0, file.rfind('/'));
}

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

bool isSource(const fs::path& path) {
    return path.extension() == ".h" || path.extension() == ".cpp";
}

std::vector<Include> allIncludes() {
    std::vector<Include> found;
    for (const std::string& folder : kFolders)
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLOBULAR_SOURCE) / folder)) {
            if (!isSource(entry.path())) continue;
            std::ifstream stream(entry.path());
            const auto here = includesIn(folder, fs::relative(entry.path(), GLOBULAR_SOURCE).string(), stream);
            found.insert(found.end(), here.begin(), here.end());
        }
    return found;
}

/// How an include between two rooms of one folder is wrong; empty if it is not.
std::string roomVerdict(const Include& include) {
    const auto rooms = kRooms.find(include.folder);
    if (rooms == kRooms.end() || include.target.rfind(include.folder + "/", 0) != 0) return "";
    const auto indexOf = [&](const std::string& file) {
        return std::find(rooms->second.begin(), rooms->second.end(), roomOf(file)) - rooms->second.begin();
    };
    const auto roomCount = static_cast<std::ptrdiff_t>(rooms->second.size());
    if (indexOf(include.file) == roomCount) return roomOf(include.file) + " is not a known room";
    if (indexOf(include.target) == roomCount) return roomOf(include.target) + " is not a known room";
    if (indexOf(include.target) >= indexOf(include.file)) return "";
    return roomOf(include.file) + " must not include " + roomOf(include.target) + ", which is above it";
}

/// Whether a room includes the headers of OpenGL and EGL.
bool isOpenGlRoom(const std::string& room) {
    return room == "render/opengl" || room == "render/opengl/context";
}

/// The files of these rooms that a build without OpenGL has, too, of which the headers are for the other rooms.
const std::set<std::string> kWithoutOpenGl = {
    "render/opengl/context/context.h",  "render/opengl/context/context_none.cpp",
    "render/opengl/context/device.cpp", "render/opengl/context/device.h",
    "render/opengl/opengl_renderer.h",  "render/opengl/opengl_renderer_none.cpp"};

/// How an include needs OpenGL where it may be missing; empty if it does not.
std::string openGlVerdict(const Include& include) {
    static const std::set<std::string> kOpenGlFolders = {"GL", "EGL", "KHR"};
    const bool isOpenGls = kOpenGlFolders.count(include.target.substr(0, include.target.find('/'))) == 1;
    if (isOpenGls && !isOpenGlRoom(roomOf(include.file)))
        return roomOf(include.file) + " must not include OpenGL's headers";
    const bool isOfRoom = isOpenGlRoom(roomOf(include.target)) && kWithoutOpenGl.count(include.target) == 0;
    if (kWithoutOpenGl.count(include.file) == 1 && (isOpenGls || isOfRoom))
        return include.file + " is compiled without OpenGL, too";
    return "";
}

/// The files that may include OpenVDB, which may be missing: modules, and what reads their files back.
const std::set<std::string> kWithOpenVdb = {"render/mesh/isosurface_openvdb.cpp", "scenes/shapes/distances_openvdb.cpp",
                                            "tests/render/mesh_vdb_test.cpp"};

/// The file that may include assimp, which may be missing.
constexpr const char* kWithAssimp = "scenes/shapes/mesh_file_assimp.cpp";

/// The file that may include OpenEXR, which may be missing.
constexpr const char* kWithOpenExr = "render/output/exr_openexr.cpp";

/// Whether a target is a header of OpenEXR, which have no folder.
bool isOpenExrs(const std::string& target) {
    return target.starts_with("Imf") || target.starts_with("OpenEXR") || target == "half.h";
}

/// Whether a target is a header of MPI or Zoltan, which only the program globular-mpi is built with.
bool isOfSeveralProcesses(const std::string& target) {
    return target == "mpi.h" || target.starts_with("zoltan");
}

/// Why an include is wrong; empty if it is not.
std::string verdict(const Include& include) {
    const std::string target = include.target.substr(0, include.target.find('/'));
    if (kFolders.count(target) == 1 && target != include.folder && kAllowed.at(include.folder).count(target) == 0 &&
        kAllowedFiles.count({include.folder, include.target}) == 0)
        return include.folder + "/ must not include " + target + "/";
    if (include.target.find("..") != std::string::npos) return "paths start at the root, not at ..";
    if (const std::string wrongRoom = roomVerdict(include); !wrongRoom.empty()) return wrongRoom;
    if (const std::string needsOpenGl = openGlVerdict(include); !needsOpenGl.empty()) return needsOpenGl;
    if (target == "openvdb" && kWithOpenVdb.count(include.file) == 0)
        return include.file + " must not include OpenVDB, which may be missing";
    if (target == "assimp" && include.file != kWithAssimp)
        return include.file + " must not include assimp, which may be missing";
    if (isOpenExrs(include.target) && include.file != kWithOpenExr)
        return include.file + " must not include OpenEXR, which may be missing";
    if (isOfSeveralProcesses(include.target) && include.folder != "mpi")
        return include.file + " must not include MPI or Zoltan, which may be missing";
    if (target == "openvdb" || target == "assimp" || kPlainHeaders.count({include.file, include.target}) == 1)
        return "";
    const std::string refusal = include.folder + "/ must not include <" + include.target + ">";
    if (const auto libraries = kLibraries.find(include.folder); libraries != kLibraries.end()) {
        // Without a slash and with .h: the system's C headers.
        const bool isLibrary = include.target.find('/') != std::string::npos;
        if (isLibrary ? kFolders.count(target) == 0 && libraries->second.count(target) == 0
                      : include.target.find('.') != std::string::npos)
            return refusal;
    }
    const auto forbidden = kForbiddenHeaders.find(include.folder);
    if (forbidden != kForbiddenHeaders.end() && forbidden->second.count(include.target) == 1) return refusal;
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

TEST_CASE("No room holds more files than one can overlook", "[layering]") {
    std::map<std::string, std::size_t> fileCounts;
    for (const auto& [folder, rooms] : kRooms)
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLOBULAR_SOURCE) / folder))
            if (isSource(entry.path())) ++fileCounts[roomOf(fs::relative(entry.path(), GLOBULAR_SOURCE).string())];
    REQUIRE(fileCounts.size() > 20);
    for (const auto& [room, count] : fileCounts) {
        INFO(room);
        CHECK(count <= kMostFilesInRoom);
    }
}

TEST_CASE("A wrong arrow between rooms is noticed", "[layering]") {
    CHECK(verdict({"engine", "engine/core/x.h", 1, "engine/force_law/pair_law.h"}) != "");
    CHECK(verdict({"engine", "engine/force_law/x.h", 1, "engine/core/vec3.h"}) == "");
    CHECK(verdict({"engine", "engine/force_law/x.h", 1, "engine/force_law/pair_law.h"}) == "");
    CHECK(verdict({"engine", "engine/cellar/x.h", 1, "engine/core/vec3.h"}) != "");
    CHECK(verdict({"engine", "engine/force_law/x.h", 1, "engine/cellar/vec3.h"}) != "");
    CHECK(verdict({"render", "render/cpu/raster/x.cpp", 1, "render/cpu/shading/shade.h"}) != "");
    CHECK(verdict({"render", "render/renderer.cpp", 1, "render/cpu/shading/shade.h"}) == "");
    CHECK(verdict({"tools", "tools/run/x.cpp", 1, "tools/commands/commands.h"}) != "");
    CHECK(verdict({"tools", "tools/commands/x.cpp", 1, "tools/run/render_loop.h"}) == "");
}

TEST_CASE("OpenGL outside its room is noticed", "[layering]") {
    for (const char* room : {"render/cpu", "render/cpu/metaballs", "render/prepare", "render/picture"}) {
        const std::string file = std::string(room) + "/x.cpp";
        for (const char* target : {"GL/glcorearb.h", "GL/osmesa.h", "EGL/egl.h", "render/opengl/context/gl.h",
                                   "render/opengl/context/context.h", "render/opengl/context/device.h"}) {
            INFO(file << ": " << target);
            CHECK(verdict({"render", file, 1, target}) != "");
        }
    }
    CHECK(verdict({"render", "render/renderer.cpp", 1, "render/opengl/context/context.h"}) == "");
    CHECK(verdict({"render", "render/renderer.h", 1, "GL/glcorearb.h"}) != "");
    CHECK(verdict({"tools", "tools/run/x.cpp", 1, "EGL/egl.h"}) != "");
    CHECK(verdict({"render", "render/opengl/context/gl.h", 1, "GL/glcorearb.h"}) == "");
    CHECK(verdict({"render", "render/opengl/context/context.h", 1, "GL/glcorearb.h"}) != "");
    CHECK(verdict({"render", "render/opengl/context/context.h", 1, "render/opengl/context/gl.h"}) != "");
    CHECK(verdict({"render", "render/opengl/context/context.h", 1, "render/opengl/context/device.h"}) == "");
    CHECK(verdict({"render", "render/opengl/context/context_none.cpp", 1, "render/opengl/context/context_native.h"}) !=
          "");
}

TEST_CASE("OpenVDB outside its file is noticed", "[layering]") {
    CHECK(verdict({"render", "render/mesh/isosurface_openvdb.cpp", 1, "openvdb/openvdb.h"}) == "");
    CHECK(verdict({"render", "render/mesh/surface_mesh.cpp", 1, "openvdb/openvdb.h"}) != "");
    CHECK(verdict({"tools", "tools/commands/mesh_command.cpp", 1, "openvdb/openvdb.h"}) != "");
    CHECK(verdict({"render", "render/prepare/skin/skin.cpp", 1, "render/mesh/surface_mesh.h"}) != "");
}

TEST_CASE("OpenEXR outside its file is noticed", "[layering]") {
    CHECK(verdict({"render", "render/output/exr_openexr.cpp", 1, "ImfHeader.h"}) == "");
    CHECK(verdict({"render", "render/output/exr.cpp", 1, "ImfHeader.h"}) != "");
    CHECK(verdict({"tools", "tools/run/render_loop.cpp", 1, "half.h"}) != "");
}

TEST_CASE("What reads meshes outside its files is noticed", "[layering]") {
    CHECK(verdict({"scenes", "scenes/shapes/mesh_file_assimp.cpp", 1, "assimp/scene.h"}) == "");
    CHECK(verdict({"scenes", "scenes/shapes/mesh_file.cpp", 1, "assimp/scene.h"}) != "");
    CHECK(verdict({"scenes", "scenes/shapes/distances_openvdb.cpp", 1, "openvdb/openvdb.h"}) == "");
    CHECK(verdict({"scenes", "scenes/shapes/mesh_distances.cpp", 1, "openvdb/openvdb.h"}) != "");
    CHECK(verdict({"scenes", "scenes/shapes/mesh_file.cpp", 1, "dlfcn.h"}) == "");
    CHECK(verdict({"scenes", "scenes/shapes/mesh.cpp", 1, "dlfcn.h"}) != "");
}

TEST_CASE("MPI outside its folder is noticed", "[layering]") {
    CHECK(verdict({"mpi", "mpi/x.cpp", 1, "mpi.h"}) == "");
    CHECK(verdict({"mpi", "mpi/x.cpp", 1, "zoltan.h"}) == "");
    CHECK(verdict({"engine", "engine/ranks/x.h", 1, "mpi.h"}) != "");
    CHECK(verdict({"tools", "tools/run/x.cpp", 1, "zoltan_cpp.h"}) != "");
    CHECK(verdict({"tools", "tools/run/x.cpp", 1, "mpi/rank_host.h"}) != "");
    CHECK(verdict({"mpi", "mpi/x.cpp", 1, "tools/run/simulation_host.h"}) == "");
    CHECK(verdict({"mpi", "mpi/x.cpp", 1, "render/picture/view.h"}) != "");
}

TEST_CASE("A wrong arrow is noticed", "[layering]") {
    CHECK(verdict({"engine", "engine/core/x.cpp", 1, "scenes/model/scene.h"}) != "");
    CHECK(verdict({"render", "render/picture/x.cpp", 1, "engine/core/vec3.h"}) != "");
    CHECK(verdict({"scenes", "scenes/text/x.cpp", 1, "render/opengl/context/context.h"}) != "");
    CHECK(verdict({"scenes", "scenes/text/x.cpp", 1, "render/picture/view.h"}) == "");
    CHECK(verdict({"engine", "engine/core/x.cpp", 1, "chrono"}) != "");
    CHECK(verdict({"engine", "engine/core/x.cpp", 1, "unistd.h"}) != "");
    CHECK(verdict({"engine", "engine/core/x.cpp", 1, "glm/vec3.hpp"}) != "");
    CHECK(verdict({"engine", "engine/core/x.cpp", 1, "Eigen/Geometry"}) == "");
    CHECK(verdict({"render", "render/picture/x.cpp", 1, "../scenes/scene.h"}) != "");
    CHECK(verdict({"studies", "studies/common/x.cpp", 1, "tools/pages/html.h"}) != "");
    CHECK(verdict({"studies", "studies/common/x.cpp", 1, "fstream"}) != "");
    CHECK(verdict({"studies", "studies/common/x.cpp", 1, "chrono"}) == "");
    CHECK(verdict({"scenes", "scenes/text/x.cpp", 1, "studies/accuracy/accuracy.h"}) != "");
    CHECK(verdict({"tools", "tools/system/x.cpp", 1, "tests/engine/clouds.h"}) != "");
}
