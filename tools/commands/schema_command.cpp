// globular schema: every key that a scene file may contain, as text, JSON, JSON Schema or Markdown.
#include <fmt/format.h>

#include <memory>

#include "scenes/schema/schema_export.h"
#include "tools/commands/commands.h"
#include "tools/system/json.h"
#include "tools/system/process.h"

namespace tools {

void addSchemaCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("schema", "every key of a scene file with type, unit, default, range, help");
    const auto json = std::make_shared<bool>(false);
    const auto jsonSchema = std::make_shared<bool>(false);
    const auto markdown = std::make_shared<bool>(false);
    CLI::Option* rows = command.add_flag("--json", *json, "the keys as JSON, one object per line");
    CLI::Option* editor =
        command.add_flag("--json-schema", *jsonSchema, "a JSON Schema, with which editors check scene files");
    command.add_flag("--markdown", *markdown, "the page docs/scenes.md")->excludes(rows)->excludes(editor);
    editor->excludes(rows);
    command.footer("Example: globular schema --json-schema > globular.schema.json");
    command.callback([json, jsonSchema, markdown] {
        if (!*json) {
            fmt::print("{}", *jsonSchema ? scenes::jsonSchema()
                             : *markdown ? scenes::schemaMarkdown()
                                         : scenes::schemaText());
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
