// globular schema: lists every key that a scene file may have.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "scenes/schema/schema_export.h"
#include "tools/commands/commands.h"
#include "tools/system/json.h"

namespace tools {

void addSchemaCommand(const Command& program) {
    const Command command =
        program.command("schema", "every key of a scene file with type, unit, default, range, help");
    const auto json = std::make_shared<bool>(false);
    command.flag("--json", *json, "one JSON object a line");
    command.example("globular schema");
    command.run([json] {
        if (!*json) {
            fmt::print("{}", scenes::schemaText());
            return;
        }
        for (const scenes::SchemaRow& row : scenes::schemaRows())
            printJson(Json{{"key", row.key},
                           {"type", row.type},
                           {"unit", row.unit},
                           {"default", row.defaultText},
                           {"range", row.range},
                           {"applies_to", row.appliesTo},
                           {"help", row.help}});
    });
}

}  // namespace tools
