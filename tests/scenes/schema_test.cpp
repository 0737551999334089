// Tests the schema: it is complete and consistent with itself and with the engine, and is exported in full.
#include "tests/catch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "engine/force_law/material.h"
#include "scenes/schema/document.h"
#include "scenes/schema/preset_info.h"
#include "scenes/schema/schema.h"
#include "scenes/schema/schema_export.h"
#include "scenes/schema/typed_value.h"

using scenes::Key;
using scenes::schema;

TEST_CASE("every key has a help line and a known table, and occurs once") {
    std::set<std::string> paths;
    for (const Key& key : schema()) {
        INFO(pathOf(key));
        CHECK(!key.help.empty());
        CHECK(key.help.find('\n') == std::string_view::npos);
        CHECK(paths.insert(pathOf(key)).second);
        REQUIRE(scenes::findTable(key.table) != nullptr);
        CHECK(scenes::findKey(key.table, key.name) == &key);
        CHECK((pathOf(key).find("[]") != std::string::npos) == scenes::findTable(key.table)->allowsList);
    }
    CHECK(schema().size() > 80);
}

TEST_CASE("every key is required or has a constant or derived default") {
    for (const Key& key : schema()) {
        INFO(pathOf(key));
        CHECK(key.isRequired + !key.defaultValue.empty() + !key.derivedDefault.empty() == 1);
    }
}

TEST_CASE("every default is valid for its own key") {
    for (const Key& key : schema()) {
        if (key.defaultValue.empty()) continue;
        INFO(pathOf(key) << " = " << key.defaultValue);
        scenes::ProblemList problems("schema", {});
        CHECK(scenes::validateValue(key, scenes::parseOverrideValue(std::string(key.defaultValue), -1), problems)
                  .has_value());
        CHECK(problems.empty());
    }
}

TEST_CASE("exactly the keys of type choice have choices") {
    for (const Key& key : schema()) {
        INFO(pathOf(key));
        CHECK(key.choices.empty() == (key.type != scenes::Type::choice));
    }
}

TEST_CASE("keys apply to values of their table's discriminator") {
    for (const Key& key : schema()) {
        INFO(pathOf(key));
        if (key.appliesTo.empty()) continue;
        const scenes::TableInfo& table = *scenes::findTable(key.table);
        const Key* discriminator = scenes::findKey(table.name, table.discriminator);
        REQUIRE(discriminator != nullptr);
        for (const std::string_view value : key.appliesTo)
            CHECK(std::count(discriminator->choices.begin(), discriminator->choices.end(), value) == 1);
    }
}

TEST_CASE("rows show each key with type, unit, default, range and help") {
    const std::vector<scenes::SchemaRow> rows = scenes::schemaRows();
    REQUIRE(rows.size() == schema().size());
    const auto row = [&](const std::string& key) {
        const auto found =
            std::find_if(rows.begin(), rows.end(), [&](const auto& candidate) { return candidate.key == key; });
        REQUIRE(found != rows.end());
        return *found;
    };
    CHECK(row("fps").type == "integer or fraction");
    CHECK(row("fps").unit == "1/s");
    CHECK(row("fps").defaultText == "30");
    CHECK(row("fps").range == "1 to 240");
    CHECK(row("title").defaultText == "required");
    CHECK(row("still.time").defaultText == "(half the duration)");
    CHECK(row("physics.stepper").range ==
          "symplectic-euler | velocity-verlet | leapfrog | implicit-damping | linearly-implicit | auto");
    CHECK(row("body[].center").appliesTo ==
          "shape ball, grid, cylinder, cone, frustum, capsule, shell, revolution, mesh, text, image");
    CHECK(row("material[].core").range == "> 0 and < 1");
}

TEST_CASE("the text shows every key under the header of its table") {
    const std::string text = scenes::schemaText();
    for (const Key& key : schema()) {
        INFO(pathOf(key));
        const scenes::TableInfo& table = *scenes::findTable(key.table);
        std::string header = "# keys above";
        if (!table.name.empty()) header.assign("[").append(table.name).append("]");
        const std::size_t at = text.find(header);
        REQUIRE(at != std::string::npos);
        std::string name = "\n  ";
        name.append(key.name).append(" ");
        CHECK(text.find(name, at) != std::string::npos);
        CHECK(text.find(std::string(key.help)) != std::string::npos);
    }
}

TEST_CASE("every preset is described, in the order of the presets, and its constants are those of the engine") {
    const std::string text = scenes::schemaText();
    const std::string page = scenes::schemaMarkdown();
    const auto presets = engine::materialPresets();
    REQUIRE(scenes::presetInfos().size() == presets.size());
    for (std::size_t index = 0; index < presets.size(); ++index) {
        const scenes::PresetInfo& info = scenes::presetInfos()[index];
        INFO(info.name);
        CHECK(info.name == presets[index].name);
        CHECK(text.find(std::string(info.behavior)) != std::string::npos);
        CHECK(page.find("| `" + std::string(info.name) + "` | " + std::string(info.behavior)) != std::string::npos);
    }
    CHECK(text.find("radius 0.08 m, mass 0.015 kg, b1 0.03, bd 1.2, cr 1, cd 1, friction 0.3") != std::string::npos);
    CHECK(page.find(" | 0.08 | 0.015 | 0.03 | 1.2 | 1 | 1 | 0.3 | ") != std::string::npos);
}

TEST_CASE("the page shows pictures of what the constants do and of all shapes, which are there") {
    for (const std::string picture : {"constants", "bodies", "shapes"}) {
        CHECK(scenes::schemaMarkdown().find("](" + picture + ".webp)") != std::string::npos);
        CHECK(std::filesystem::exists(GLOBULAR_SOURCE "/docs/" + picture + ".webp"));
    }
}

TEST_CASE("docs/scenes.md is current") {
    std::ifstream file(GLOBULAR_SOURCE "/docs/scenes.md", std::ios::binary);
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    INFO("bring it up to date with: build/release/globular schema --markdown > docs/scenes.md");
    CHECK((page == scenes::schemaMarkdown()));
}

TEST_CASE("ranges and units are put into words") {
    CHECK(scenes::rangeText({}) == "");
    CHECK(scenes::rangeText({.low = 0.0}) == ">= 0");
    CHECK(scenes::rangeText({.low = 0.0, .isLowExcluded = true}) == "> 0");
    CHECK(scenes::rangeText({.low = 0.0, .high = 0.5}) == "0 to 0.5");
    CHECK(scenes::rangeText({.high = 2.0, .isHighExcluded = true}) == "< 2");
    CHECK(scenes::unitWords("m") == "meters");
    CHECK(scenes::unitWords("N m^4") == "N m^4");
}
