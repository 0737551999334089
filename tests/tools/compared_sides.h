// Two folders of pictures that are compared, for the tests of globular compare.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/tools/golden_files.h"
#include "tests/tools/program.h"

namespace golden_files {

using Json = nlohmann::json;

/// A folder with actual and expected pictures that can be compared.
class Sides {
 public:
    void actual(const std::string& name, const render::Image& image) {
        writePicture(folder_ / ("actual/" + name), image);
    }
    void expected(const std::string& name, const render::Image& image) {
        writePicture(folder_ / ("expected/" + name), image);
    }
    void both(const std::string& name, const render::Image& image) {
        actual(name, image);
        expected(name, image);
    }
    fs::path operator/(const std::string& name) const { return folder_ / name; }
    program::Outcome compare(const std::string& more = "") const {
        return program::run("compare " + (folder_ / "actual").string() + " " + (folder_ / "expected").string() + " " +
                            more);
    }
    /// The JSON object of each picture by its name, and the summary as "done".
    std::map<std::string, Json> results(const std::string& more = "") const {
        std::istringstream lines(compare("--json " + more).out);
        std::map<std::string, Json> results;
        for (std::string line; std::getline(lines, line);) {
            const Json json = Json::parse(line);
            results[json["event"] == "done" ? "done" : json["name"].get<std::string>()] = json;
        }
        return results;
    }

 private:
    program::Folder folder_;
};

}  // namespace golden_files
