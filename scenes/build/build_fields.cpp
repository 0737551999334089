// Makes the fields of the simulation from the [[field]] tables of a scene.
#include <numbers>
#include <variant>

#include "scenes/build/builders.h"

namespace scenes {
namespace {

using engine::Vec3;

std::variant<engine::UniformField, engine::PointField, engine::FlowField> lawFrom(const Section& section) {
    const std::string& kind = section.string("kind");
    if (kind == "uniform") return engine::UniformField{section.vector("acceleration")};
    if (kind == "point")
        return engine::PointField{.center = section.vector("center"),
                                  .strength = section.number("strength"),
                                  .softening = section.number("softening")};
    engine::FlowField flow{.rate = section.number("rate")};
    if (kind == "drag") flow.velocity = section.vector("velocity");
    if (kind == "vortex") {
        flow.spin = 2.0 * std::numbers::pi * section.vector("spin");
        flow.center = section.vector("center");
    }
    return flow;
}

}  // namespace

std::vector<engine::Field> buildFields(std::vector<Section>& sections, BuildContext& context) {
    std::vector<engine::Field> fields;
    for (Section& section : sections) {
        checkCorners(section, Flatness::forbidden, context);
        if (section.has("start") && section.has("until") && section.number("until") <= section.number("start"))
            report(section, "until", context, "until is {}, must be after start, {} (seconds)",
                   section.canonical("until"), section.canonical("start"));
        if (section.has("kind") && section.string("kind") == "vortex" && section.has("spin") &&
            section.vector("spin") == Vec3::Zero())
            report(section, "spin", context, "spin is [0, 0, 0], must not be zero");
        if (!section.has("kind") || !section.isValid()) continue;
        engine::Field field{.law = lawFrom(section)};
        if (section.has("minimum") || section.has("maximum")) field.box = engine::BoundingBox::unbounded();
        if (section.has("minimum")) field.box->low = section.vector("minimum");
        if (section.has("maximum")) field.box->high = section.vector("maximum");
        field.start = section.number("start");
        if (section.has("until")) field.until = section.number("until");
        fields.push_back(field);
    }
    return fields;
}

}  // namespace scenes
