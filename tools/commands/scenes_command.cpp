// globular scenes: lists the built-in scenes.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "scenes/build/library.h"
#include "tools/commands/commands.h"
#include "tools/run/options.h"
#include "tools/system/json.h"
#include "tools/system/process.h"

namespace tools {

void addScenesCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("scenes", "the built-in scenes");
    const auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "one JSON object a line");
    command.footer("Example: globular scenes");
    command.callback([json] {
        const auto list = scenes::listScenes(sceneFolder());
        std::size_t width = 0;
        for (const auto& scene : list) width = std::max(width, scene.name.size());
        for (const auto& scene : list) {
            if (*json)
                printJson(Json{{"name", scene.name}, {"title", scene.title}, {"path", scene.path}});
            else
                printText(fmt::format("{:<{}}  {}\n", scene.name, width, scene.title));
        }
    });
}

}  // namespace tools
