// The material presets in words. The colors were chosen to be easy to tell apart on light and dark backgrounds. The
// words were found by looking at each preset in docs/constants.toml with `--set material.preset=NAME`, and at a ball of
// it, 1.4 m across, that falls 0.9 m onto a floor.
#include "scenes/schema/preset_info.h"

#include <algorithm>
#include <array>

namespace scenes {

std::span<const PresetInfo> presetInfos() {
    static constexpr std::array<PresetInfo, 11> infos = {{
        {"liquid", "#3f86c8", "the paper's liquid: thin and very soft; its own weight squeezes it flat"},
        {"solid", "#c8794a", "a lump that draws itself together; it dents where it lands, and does not flow"},
        {"powder", "#d8b878", "hard grains without friction; bounces, runs apart and levels, and never heaps up"},
        {"fountain", "#58a8dc", "the same constants as liquid, in another color"},
        {"honey", "#d98a12", "thick, does not splash; a ball of it sinks to a flat cake within half a minute"},
        {"jam", "#9c1430", "the thickest; does not splash, and stays a mound"},
        {"oil", "#d9b63a", "thin and smooth; runs and levels, and hardly splashes"},
        {"lava", "#ff5a14", "thick; slumps within seconds to a low cake, which stays"},
        {"mud", "#6b4a2f", "thicker than honey; slumps slowly and comes to rest as a mound"},
        {"molten-metal", "#ffb347", "the thinnest; splashes into many small drops and levels soon"},
        {"sand", "#d9b36c", "grains with friction; slides and heaps up, and the slope stays"},
    }};
    return infos;
}

const PresetInfo& presetInfo(std::string_view name) {
    return *std::ranges::find(presetInfos(), name, &PresetInfo::name);
}

}  // namespace scenes
