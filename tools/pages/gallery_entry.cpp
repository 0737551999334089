// A record is a JSON object with the identity of the pictures and the numbers of the run.
#include "tools/pages/gallery_entry.h"

namespace tools {

Json galleryRecord(const Json& identity, const GalleryRun& run) {
    return {{"gallery", identity},       {"particles", run.particles},
            {"births", run.births},      {"deaths", run.deaths},
            {"steps", run.steps},        {"seconds", run.seconds},
            {"threads", run.threads},    {"instruction_set", run.instructionSet},
            {"processor", run.processor}};
}

std::optional<GalleryRun> galleryRunIn(const Json& record, const Json& identity) {
    if (!record.is_object() || record.value("gallery", Json()) != identity) return std::nullopt;
    try {
        GalleryRun run;
        record.at("particles").get_to(run.particles);
        record.at("births").get_to(run.births);
        record.at("deaths").get_to(run.deaths);
        record.at("steps").get_to(run.steps);
        record.at("seconds").get_to(run.seconds);
        record.at("threads").get_to(run.threads);
        record.at("instruction_set").get_to(run.instructionSet);
        record.at("processor").get_to(run.processor);
        return run;
    } catch (const Json::exception&) {
        return std::nullopt;  // a key is missing or has a value of another kind
    }
}

}  // namespace tools
