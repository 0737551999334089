// Validates the tables and keys of a scene against the schema. Called by build/read_scene.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/schema/document.h"
#include "scenes/schema/section.h"

namespace scenes {

/// The tables of a scene. Those that are not written hold their defaults.
struct Sections {
    Section top;
    Section physics;
    Section world;
    Section look;
    Section overlay;
    Section still;
    std::vector<Section> materials;  ///< at least one
    std::vector<Section> bodies;
    std::vector<Section> emitters;
    std::vector<Section> obstacles;
    std::vector<Section> cameras;  ///< at least one
    std::optional<Section> study;  ///< only if it is written
    bool mayBeIncomplete = false;  ///< a table could not be read, so what seems to be missing may be in it

    /// All sections in the order of the schema.
    std::vector<const Section*> all() const;
};

/// Reads all tables. Records every problem that the schema alone can tell: unknown, missing, invalid and inapplicable
/// keys.
Sections readSections(const Document& document, ProblemList& problems);

/// "radius is missing, a body of shape "ball" needs it (meters)".
std::string missingText(const Section& section, const Key& key);

}  // namespace scenes
