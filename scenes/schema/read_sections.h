// Located values to sections: every table and key of a scene held against the schema. Called by scene.cpp.
#pragma once

#include <optional>
#include <vector>

#include "scenes/schema/document.h"
#include "scenes/schema/section.h"

namespace scenes {

/// The tables of a scene. Those that were not written hold their defaults.
struct Sections {
    Section top;
    Section physics;
    Section world;
    Section look;
    Section overlay;
    Section still;
    std::vector<Section> materials;
    std::vector<Section> bodies;
    std::vector<Section> emitters;
    std::vector<Section> obstacles;
    std::vector<Section> cameras;  ///< at least one
    std::optional<Section> study;  ///< only if it was written
    bool doubtful = false;         ///< some table could not be read, so what is missing may be in it

    /// All of them in the order of the schema.
    std::vector<const Section*> all() const;
};

/// Records everything that the schema alone can tell to be wrong: unknown, missing, unfit and inapplicable keys.
Sections readSections(const Document& document, ProblemList& problems);

}  // namespace scenes
