// Makes the description of a stability study from the [study] table of a scene.
#include "engine/stepping/take_step.h"
#include "scenes/build/builders.h"

namespace scenes {
namespace {

Observable observableOf(const Section& section) {
    for (const ObservableInfo& info : observables())
        if (info.name == section.string("observable")) return info.observable;
    return Observable::positionError;
}

void checkReference(Section& section, const Study& study, BuildContext& context) {
    const ObservableInfo& info = infoOf(study.observable);
    if (info.needsReference && !section.isGiven("reference_step"))
        report(section, "observable", context, "reference_step is missing, observable {} needs it (seconds)",
               tomlString(info.name));
}

void checkLimits(Section& section, const Study& study, BuildContext& context) {
    if (study.atLeast && *study.atLeast > study.limit)
        report(section, "at_least", context, "at_least is {}, must be at most the limit, {}",
               section.canonical("at_least"), section.canonical("limit"));
}

}  // namespace

Study buildStudy(Section& section, BuildContext& context) {
    Study study;
    if (!section.isValid()) return study;
    study.number = static_cast<int>(section.integer("number"));
    study.observable = observableOf(section);
    study.limit = section.number("limit");
    if (section.has("at_least")) study.atLeast = section.number("at_least");
    study.paperMustFail = section.boolean("paper_must_fail");
    study.paperStep = section.number("paper_step");
    if (section.has("reference_step")) study.referenceStep = section.number("reference_step");
    for (const engine::StepperKind stepper : engine::kSteppers)
        if (engine::nameOf(stepper) == section.string("reference_stepper")) study.referenceStepper = stepper;
    study.vary = section.strings("vary");
    if (section.has("quick")) study.quick = section.strings("quick");
    checkReference(section, study, context);
    checkLimits(section, study, context);
    return study;
}

}  // namespace scenes
