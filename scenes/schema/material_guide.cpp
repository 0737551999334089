// Writes the presets and their constants as text and as Markdown, and what each constant does.
#include "scenes/schema/material_guide.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/force_law/compression.h"
#include "engine/force_law/material.h"
#include "scenes/schema/preset_info.h"

namespace scenes {
namespace {

/// To what share of its height a column of a material sinks that is 2 m high, as `globular check` predicts it: "55 %".
/// Empty for a material that draws itself together, and so does not fill a column between walls.
std::string settledText(const engine::Material& material) {
    const engine::Column column{.height = 2.0, .spacing = 2.0 * material.radius};
    if (engine::drawsTogether(material, column)) return {};
    return fmt::format("{:.0f} %", 100.0 * engine::settledShare(material, column));
}

constexpr std::string_view kConstantsMarkdown = R"(
### What the constants do

![Rows of pictures of one scene, in each of which one constant grows from left to right](constants.webp)

The block of oil of [constants.toml](constants.toml) in its tank, 1.2 s after it was let go (`tools/gallery.sh constants` draws
it). In each row one key grows from left to right. The row of `cr` shows a smaller block without the tank, that of `friction` the
preset `sand`.

| Key | More of it is | What comes with it |
|---|---|---|
| `b1` | stiffer: less squeezed by its own weight, and so a higher level | much more of it takes shorter steps |
| `bd` | thicker: slower, smoother, without splashes | |
| `cr` | stickier: above 1 there are threads and drops, at 1.6 one lump | the more above 1.4, the more the lump shrinks |
| `cd` | thicker, like `bd`: motion is passed on further | more neighbors, which take longer to compute |
| `friction` | steeper: heaps stand; at 0 everything levels | |
| `radius` | coarser | `mass`, `b1` and `bd` follow, so that it stays the same substance; half of it takes eight times the particles |

What counts is `b1` and `bd` for each kilogram: twice the `mass` moves as half of both would.
)";

}  // namespace

std::string presetsText() {
    std::size_t width = 0;
    for (const PresetInfo& info : presetInfos()) width = std::max(width, info.name.size());
    std::string text = "# values of material.preset\n";
    for (const engine::Material& preset : engine::materialPresets()) {
        text += fmt::format("  {:<{}}  {}\n", preset.name, width, presetInfo(preset.name).behavior);
        text += fmt::format("  {:<{}}    radius {} m, mass {} kg, b1 {}, bd {}, cr {}, cd {}, friction {}\n", "", width,
                            preset.radius, preset.mass, preset.repulsion, preset.damping, preset.repulsionReach,
                            preset.dampingReach, preset.friction);
    }
    return text;
}

std::string materialGuideMarkdown() {
    std::string text = R"(
### Presets

| Preset | Looks and moves like | `radius` | `mass` | `b1` | `bd` | `cr` | `cd` | `friction` | 2 m sink to |
|---|---|---|---|---|---|---|---|---|---|
)";
    for (const engine::Material& preset : engine::materialPresets())
        text +=
            fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", preset.name,
                        presetInfo(preset.name).behavior, preset.radius, preset.mass, preset.repulsion, preset.damping,
                        preset.repulsionReach, preset.dampingReach, preset.friction, settledText(preset));
    return text + R"(
The last column is the share of its height to which a column of 2 m sinks by its own weight between walls, as `globular check`
predicts it; `compression` makes a material stiffer. `solid` draws itself together, away from the walls.
)" + std::string(kConstantsMarkdown);
}

}  // namespace scenes
