// Validates the tables and keys of a scene against the schema. Called by build/read_scene.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/schema/document.h"
#include "scenes/schema/section.h"

namespace scenes {

/// The validated tables of a scene. A table that is not written holds the defaults of its keys.
struct Sections {
    Section top;
    Section physics;
    Section world;
    Section air;
    Section look;
    Section overlay;
    Section still;
    std::vector<Section> materials;  ///< at least one
    std::vector<Section> bodies;
    std::vector<Section> emitters;
    std::vector<Section> obstacles;
    std::vector<Section> fields;
    std::vector<Section> cameras;  ///< at least one
    std::optional<Section> study;  ///< only if it is written
    bool mayBeIncomplete = false;  ///< a table could not be read, and seemingly missing keys may be in it

    /// All tables in the order of the schema, each followed by those within it.
    std::vector<const Section*> all() const;
};

/// Reads all tables of a scene. Records every problem that the schema alone can tell: unknown and missing keys, invalid
/// values, and keys that do not apply.
Sections readSections(const Document& document, ProblemList& problems);

/// The message about a missing key, such as "radius is missing, a body of shape "ball" needs it (meters)".
std::string missingText(const Section& section, const Key& key);

}  // namespace scenes
