// The keys of one table held against the schema. Called by read_sections.cpp.
#pragma once

#include <string>

#include "scenes/schema/section.h"
#include "scenes/text/problem_list.h"

namespace scenes {

struct TableSource {
    const TableInfo& info;
    std::string prefix;               ///< "body[0]"
    const Value& value;               ///< a table; an empty one if the scene has none
    bool damaged = false;             ///< something of the file could not be read: missing keys are not reported
    const Section* before = nullptr;  ///< the item before it, where its table inherits
};

/// The checked table, with what it inherits and the schema's defaults.
Section readTable(const TableSource& source, ProblemList& problems);

/// "radius is missing, a body of shape "ball" needs it (meters)".
std::string missingText(const Section& section, const Key& key);

}  // namespace scenes
