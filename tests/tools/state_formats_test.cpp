// Tests `simulate --format`: several formats in one folder, their index, and that each keeps what holds for one: a run
// makes exactly the files that are missing or damaged, and touches none of another origin.
#include <map>
#include <nlohmann/json.hpp>

#include "render/mesh/isosurface.h"
#include "tests/catch.h"
#include "tests/tools/early_ends.h"

using program::Folder;
using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

bool hasOpenVdb() {
    return !render::openVdbVersion().empty();
}

/// All formats that this build has.
const std::string& all() {
    static const std::string formats = std::string("ply,ply-float,vtp,extxyz,lammps") + (hasOpenVdb() ? ",vdb" : "");
    return formats;
}

std::string states(const fs::path& folder, const std::string& more) {
    return "simulate measured/powder --quiet --checkpoint 0 -o " + folder.string() + " " + more;
}

/// The contents of the files of particles and their index, by name.
std::map<std::string, std::string> particlesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("particles"))
            files[entry.path().filename().string()] = textOf(entry.path());
    return files;
}

std::map<std::string, fs::file_time_type> timesIn(const fs::path& folder) {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& [name, text] : particlesIn(folder)) times[name] = fs::last_write_time(folder / name);
    return times;
}

/// The names and times of the series in a folder.
std::map<std::string, double> seriesIn(const fs::path& folder) {
    std::map<std::string, double> series;
    const auto json = nlohmann::json::parse(textOf(folder / "particles.vtp.series"));
    for (const auto& file : json["files"]) series[file["name"]] = file["time"];
    return series;
}

}  // namespace

TEST_CASE("simulate writes the formats that are asked for and no others", "[state-formats]") {
    const Folder folder;
    const auto namesFor = [&](const std::string& flags) {
        REQUIRE(run(states(folder / "a", "--frames 1 --overwrite " + flags)).code == 0);
        std::vector<std::string> names;
        for (const auto& [name, text] : particlesIn(folder / "a")) names.push_back(name);
        return names;
    };
    using Names = std::vector<std::string>;
    CHECK(namesFor("") == Names{"particles-00001.ply"});
    CHECK(namesFor("--format lammps") == Names{"particles-00001.lammpstrj"});
    CHECK(namesFor("--format vtp") == Names{"particles-00001.vtp", "particles.vtp.series"});
    CHECK(namesFor("--format extxyz,ply --format ply-float --format ply") ==
          Names{"particles-00001.ply", "particles-00001.xyz", "particles-float-00001.ply"});
    const auto outcome = run(states(folder / "a", "--format obj"));
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("ply-float") != std::string::npos);
}

TEST_CASE("A run in several formats is resumed to the same bytes", "[state-formats]") {
    const Folder folder;
    const std::string flags = "--frames 2-30 --format " + all();
    REQUIRE(run(states(folder / "whole", flags)).code == 0);
    const auto whole = particlesIn(folder / "whole");
    REQUIRE(whole.size() == (hasOpenVdb() ? 6 : 5) * 29 + 1);
    const std::string tenth = "[ -e " + (folder / "a/particles-00010.xyz").string() + " ]";
    early_ends::interrupted(states(folder / "a", flags), "KILL", early_ends::onceThat(tenth), folder / "log");
    // Each file that is there is whole, and so is the series, which names no file that is not there.
    for (const auto& [name, text] : particlesIn(folder / "a"))
        if (name != "particles.vtp.series") CHECK(text == whole.at(name));
    if (fs::exists(folder / "a/particles.vtp.series"))
        for (const auto& [name, time] : seriesIn(folder / "a")) CHECK(fs::exists(folder / "a" / name));
    REQUIRE(run(states(folder / "a", flags + " --resume")).code == 0);
    CHECK(particlesIn(folder / "a") == whole);
    CHECK(seriesIn(folder / "a").size() == 29);
    CHECK(seriesIn(folder / "a").at("particles-00015.vtp") == 0.5);
}

TEST_CASE("Exactly the missing and damaged files are made again", "[state-formats]") {
    const Folder folder;
    const std::string flags = "--frames 0-5 --resume --format " + all();
    REQUIRE(run(states(folder / "a", flags)).code == 0);
    const auto whole = particlesIn(folder / "a");
    const auto before = timesIn(folder / "a");
    fs::remove(folder / "a/particles-00002.vtp");
    fs::resize_file(folder / "a/particles-00004.xyz", 100);
    const auto outcome = run(states(folder / "a", flags));
    CHECK(outcome.code == 0);
    CHECK(program::lineCount(outcome.err) == 2);
    CHECK(outcome.err.find("particles-00002.vtp is missing") != std::string::npos);
    CHECK(outcome.err.find("particles-00004.xyz is damaged") != std::string::npos);
    CHECK(particlesIn(folder / "a") == whole);
    for (const auto& [name, time] : timesIn(folder / "a")) {
        INFO(name);
        const bool isMade = name == "particles-00002.vtp" || name == "particles-00004.xyz";
        if (name != "particles.vtp.series") CHECK((time != before.at(name)) == isMade);
    }
}

TEST_CASE("The metaballs' field is written like particles, the same for any number of threads", "[state-formats]") {
    const Folder folder;
    const std::string flags = "--frames 0-3 --format vdb";
    if (!hasOpenVdb()) {
        const auto outcome = run(states(folder / "a", flags));
        CHECK(outcome.code == 1);
        CHECK(outcome.err.find("error: this build has no OpenVDB, which meshes and .vdb files need") == 0);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK_FALSE(fs::exists(folder / "a"));
        return;
    }
    REQUIRE(run(states(folder / "a", flags + " --threads 1")).code == 0);
    REQUIRE(run(states(folder / "b", flags + " --threads 2")).code == 0);
    const auto fields = particlesIn(folder / "a");
    REQUIRE(fields.size() == 4);
    CHECK(fields.count("particles-00003.vdb") == 1);
    CHECK(fields == particlesIn(folder / "b"));
    fs::resize_file(folder / "a/particles-00001.vdb", 1000);
    const auto outcome = run(states(folder / "a", flags + " --resume"));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("particles-00001.vdb is damaged") != std::string::npos);
    CHECK(particlesIn(folder / "a") == fields);
    // The field is that of the scene's metaballs, of which there may be others for the same particles.
    CHECK(run(states(folder / "a", flags + " --resume --set look.skin=smooth")).code == 1);
    REQUIRE(run(states(folder / "a", flags + " --overwrite --set look.skin=smooth")).code == 0);
    CHECK(particlesIn(folder / "a").at("particles-00003.vdb") != fields.at("particles-00003.vdb"));
    const std::string spheres = "simulate measured/powder --frames 0 --set look.style=spheres -o " + (folder / "d").string();
    CHECK(run(spheres + " --format vdb")
              .err.find("the scene is drawn as spheres; the field is of metaballs with "
                        "look.metaball_reach = 2.5") != std::string::npos);
    CHECK(run(spheres + " --format ply --overwrite").err.find("metaballs") == std::string::npos);
    // A folder of fields has no particles to draw.
    const auto drawn = run("render measured/powder --frames 1 -o " + (folder / "c").string() +
                           " --set look.skin=smooth --states " + (folder / "a").string());
    CHECK(drawn.code == 1);
    CHECK(drawn.err.find("has no states of frames 1") != std::string::npos);
}

TEST_CASE("A run in other formats adds them to what is there", "[state-formats]") {
    const Folder folder;
    REQUIRE(run(states(folder / "whole", "--frames 0-5 --format ply,vtp")).code == 0);
    REQUIRE(run(states(folder / "a", "--frames 0-5")).code == 0);
    const auto before = timesIn(folder / "a");
    CHECK_FALSE(fs::exists(folder / "a/particles.vtp.series"));
    REQUIRE(run(states(folder / "a", "--frames 0-5 --format ply,vtp --resume")).code == 0);
    CHECK(particlesIn(folder / "a") == particlesIn(folder / "whole"));
    for (const auto& [name, time] : before) CHECK(fs::last_write_time(folder / "a" / name) == time);
    // What an earlier run wrote in a format stays listed.
    REQUIRE(run(states(folder / "a", "--frames 0-5 --resume")).code == 0);
    CHECK(particlesIn(folder / "a") == particlesIn(folder / "whole"));
}

TEST_CASE("The series lists the frames that are there, with their times", "[state-formats]") {
    const Folder folder;
    const std::string vtp = " --format vtp --resume --set fps=10 ";
    REQUIRE(run(states(folder / "a", "--frames 3,7" + vtp)).code == 0);
    CHECK(seriesIn(folder / "a") ==
          std::map<std::string, double>{{"particles-00003.vtp", 0.3}, {"particles-00007.vtp", 0.7}});
    REQUIRE(run(states(folder / "a", "--frames 5" + vtp)).code == 0);
    CHECK(seriesIn(folder / "a").size() == 3);
    fs::remove(folder / "a/particles-00003.vtp");
    REQUIRE(run(states(folder / "a", "--frames 5-6" + vtp)).code == 0);
    CHECK(seriesIn(folder / "a") == std::map<std::string, double>{{"particles-00005.vtp", 0.5},
                                                                  {"particles-00006.vtp", 0.6},
                                                                  {"particles-00007.vtp", 0.7}});
    REQUIRE(run(states(folder / "a", "--frames 1 --format ply --overwrite")).code == 0);
    CHECK(particlesIn(folder / "a").size() == 1);
}

TEST_CASE("Files in a format that no run was asked for are another's", "[state-formats]") {
    const Folder folder;
    REQUIRE(run(states(folder / "a", "--frames 0-3 --format lammps")).code == 0);
    for (const char* name : {"particles-00001.ply", "particles-00001.vtp", "particles-float-00001.ply",
                             "particles-00009.lammpstrj", "particles.vtp.series"}) {
        program::writeText(folder / "a" / name, "mine");
        for (const char* more : {" --overwrite", "", " --resume"}) {
            const auto outcome = run(states(folder / "a", "--frames 0-3 --format " + all() + more));
            INFO(name << more << ": " << outcome.err);
            CHECK(outcome.code == 2);
            CHECK(outcome.err.find(std::string(name) + ": this file was not written by a run") != std::string::npos);
            CHECK(textOf(folder / "a" / name) == "mine");
        }
        fs::remove(folder / "a" / name);
    }
    CHECK(run(states(folder / "a", "--frames 0-3 --resume --format " + all())).code == 0);
    // A scene that reads one of the files must not be simulated into the folder.
    program::writeText(folder / "b.toml",
                       "title = \"b\"\nduration = 1\n[[material]]\npreset = \"powder\"\n[[material]]\nname = \"b\"\n"
                       "[[body]]\nshape = \"file\"\nfile = \"a/particles-00001.vtp\"\n");
    const auto outcome = run("simulate " + (folder / "b.toml").string() + " --overwrite -o " + (folder / "a").string());
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(fs::exists(folder / "a/particles-00001.vtp"));
}
