// Notes on motions as JSON, and as lines of a report.
#include "tools/commands/check_motions.h"

#include <fmt/format.h>

#include <optional>

#include "scenes/model/motion_notes.h"

namespace tools {
namespace {

Json motionJson(const scenes::MotionNote& note) {
    const auto ifKnown = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
    return {{"what", note.what},
            {"number", note.number},
            {"shape", note.shape.empty() ? Json(nullptr) : Json(note.shape)},
            {"text", note.text},
            {"fastest", ifKnown(note.fastest)},
            {"radii_per_frame", ifKnown(note.radiiPerFrame)}};
}

}  // namespace

Json motionsJson(const scenes::Scene& scene) {
    Json list = Json::array();
    for (const scenes::MotionNote& note : scenes::motionNotes(scene)) list.push_back(motionJson(note));
    return list;
}

std::string motionsText(const Json& motions) {
    constexpr std::size_t kMostLines = 12;  // chosen
    std::string text;
    for (std::size_t k = 0; k < motions.size(); ++k) {
        if (k >= kMostLines) return text + fmt::format("motion     ... {} in all\n", motions.size());
        const Json& each = motions[k];
        const std::string shape = each["shape"].is_null() ? "" : fmt::format(" ({})", each["shape"].get<std::string>());
        text += fmt::format("motion     {} {}{}: {}\n", each["what"].get<std::string>(),
                            each["number"].get<std::size_t>(), shape, each["text"].get<std::string>());
    }
    return text;
}

}  // namespace tools
