// Properties=species:S:1:pos:R:3:... names columns: for each property its name, its type (S string, R real, I integer,
// L logical) and its number of columns.
#include "scenes/particles/extxyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/particles/text_rows.h"
#include "scenes/text/color.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

/// How a property is called by others, and its columns here.
struct XyzMeaning {
    std::string_view property;
    std::array<std::string_view, 3> columns;  ///< empty from the number of columns on
};

constexpr std::array<XyzMeaning, 11> kXyzMeanings = {{{"pos", {"x", "y", "z"}},
                                                      {"velo", {"vx", "vy", "vz"}},
                                                      {"vel", {"vx", "vy", "vz"}},
                                                      {"velocity", {"vx", "vy", "vz"}},
                                                      {"velocities", {"vx", "vy", "vz"}},
                                                      {"radius", {"radius"}},
                                                      {"radii", {"radius"}},
                                                      {"mass", {"mass"}},
                                                      {"masses", {"mass"}},
                                                      {"material", {"material"}},
                                                      {"temperature", {"temperature"}}}};

/// Properties that mean nothing to a new simulation.
constexpr std::array<std::string_view, 3> kXyzIgnored = {"id", "color", "birth_time"};

constexpr std::string_view kPlainXyz = "species:S:1:pos:R:3";

/// Most columns of a file. Chosen: many times as many as any program writes.
constexpr std::uint64_t kMaxColumns = 1000;

/// The value of a key in a line of key=value pairs, without quotation marks; empty if there is none.
std::string_view valueOf(std::string_view line, std::string_view key) {
    std::size_t at = 0;
    while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
        const std::size_t nameEnd = std::min(line.find_first_of("= \t", at), line.size());
        const std::string_view name = line.substr(at, nameEnd - at);
        at = nameEnd;
        if (at >= line.size() || line[at] != '=') continue;
        ++at;
        const bool isQuoted = at < line.size() && (line[at] == '"' || line[at] == '\'');
        const std::size_t begin = isQuoted ? at + 1 : at;
        const std::size_t end =
            std::min(isQuoted ? line.find(line[at], begin) : line.find_first_of(" \t", begin), line.size());
        if (name == key) return line.substr(begin, end - begin);
        at = end + (isQuoted ? 1 : 0);
    }
    return {};
}

std::string_view takeField(std::string_view& text) {
    const std::size_t end = std::min(text.find(':'), text.size());
    const std::string_view field = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return field;
}

/// One property of the line of properties.
struct XyzProperty {
    std::string_view name;
    std::string_view type;
    std::uint64_t columnCount = 0;
};

std::vector<XyzProperty> propertiesOf(const TextLines& lines, std::string_view text) {
    std::vector<XyzProperty> properties;
    std::uint64_t columnCount = 0;
    while (!text.empty()) {
        XyzProperty property{takeField(text), takeField(text)};
        const std::string_view number = takeField(text);
        if (property.type.size() != 1 || std::string_view("SRIL").find(property.type) == std::string_view::npos)
            lines.fail(fmt::format("Properties: the type of \"{}\" is \"{}\", must be S, R, I or L",
                                   property.name.substr(0, 40), property.type.substr(0, 40)));
        property.columnCount = wholeNumber(
            lines, number, fmt::format("Properties: the number of columns of \"{}\"", property.name.substr(0, 40)));
        if (property.columnCount > kMaxColumns || (columnCount += property.columnCount) > kMaxColumns)
            lines.fail(fmt::format("Properties: there are more than {} columns", kMaxColumns));
        properties.push_back(property);
    }
    return properties;
}

/// What a property is here; nullptr if it is skipped, which the table then says.
const XyzMeaning* meaningOf(const TextLines& lines, const XyzProperty& property, ParticleTable& table) {
    const auto* const meaning = std::ranges::find(kXyzMeanings, property.name, &XyzMeaning::property);
    if (meaning == kXyzMeanings.end()) {
        if (std::ranges::find(kXyzIgnored, property.name) == kXyzIgnored.end())
            table.skipped.emplace_back(property.name);
        return nullptr;
    }
    const auto expected = static_cast<std::uint64_t>(
        std::ranges::count_if(meaning->columns, [](std::string_view name) { return !name.empty(); }));
    if (property.columnCount != expected || (property.type != "R" && property.type != "I"))
        lines.fail(fmt::format("Properties: {} is {}:{}, must have {} columns of type R", property.name, property.type,
                               property.columnCount, expected));
    if (table.column(meaning->columns[0]) != nullptr)
        lines.fail(fmt::format("Properties: {} is given twice", property.name));
    return meaning;
}

ParticleTable readParticles(TextLines& lines, std::uint64_t count, std::string_view comment) {
    ParticleTable table;
    const std::string_view given = valueOf(comment, "Properties");
    const std::vector<XyzProperty> properties = propertiesOf(lines, given.empty() ? kPlainXyz : given);
    table.columns.reserve(3 * properties.size());  // so that pointers to columns stay valid
    std::vector<TextColumn> columns;
    bool hasSpecies = false;
    for (const XyzProperty& property : properties) {
        const bool isSpecies =
            property.name == "species" && property.columnCount == 1 && !std::exchange(hasSpecies, true);
        const XyzMeaning* const meaning = isSpecies ? nullptr : meaningOf(lines, property, table);
        for (std::uint64_t index = 0; index < property.columnCount; ++index) {
            TextColumn& column = columns.emplace_back(TextColumn{std::string(property.name), nullptr, isSpecies});
            if (meaning != nullptr)
                column.values =
                    &table.columns.emplace_back(NumberColumn{std::string(meaning->columns.at(index)), {}}).values;
        }
    }
    readTextRows(lines, count, columns, table);
    if (!valueOf(comment, "Lattice").empty()) table.skipped.emplace_back("Lattice");
    return table;
}

}  // namespace

std::string encodeExtxyz(const ParticleFrame& frame) {
    const engine::Particles& particles = frame.particles;
    std::vector<std::string> names, colors;
    for (const std::string& name : frame.materialNames) names.push_back(asWord(name));
    for (const engine::Vec3& color : frame.materialColors) {
        const auto bytes = srgbBytes(color);
        colors.push_back(fmt::format(" {} {} {}", bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0));
    }
    std::string text = fmt::format(
        "{}\nProperties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1:material:I:1:color:R:3:birth_time:R:1{}"
        " "
        "Time={} frame={} simulation_hash=\"{}\" materials=\"{}\" pbc=\"F F F\"\n",
        particles.count(), frame.temperature.empty() ? "" : ":temperature:R:1", frame.stamp.time, frame.stamp.frame,
        frame.stamp.simulationHash, fmt::join(names, ","));
    for (std::size_t index = 0; index < particles.count(); ++index) {
        text += 'X';
        const auto put = [&](auto number) {
            text += ' ';
            putNumber(text, number);
        };
        for (const engine::Vec3& vector : {particles.position[index], particles.velocity[index]})
            for (int axis = 0; axis < 3; ++axis) put(vector[axis]);
        put(particles.radius[index]);
        put(particles.mass[index]);
        put(particles.id[index]);
        put(particles.material[index]);
        text += colors.at(particles.material[index]);
        put(particles.birthTime[index]);
        if (!frame.temperature.empty()) put(frame.temperature[index]);
        text += '\n';
    }
    return text;
}

bool isExtxyz(std::string_view bytes) {
    std::string_view line = bytes.substr(0, std::min(bytes.find('\n'), std::size_t{100}));
    const std::string_view word = takeWord(line);
    return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos && takeWord(line).empty();
}

ParticleTable readExtxyz(std::string_view bytes, const std::string& fileName) {
    TextLines lines(bytes, fileName);
    for (std::uint64_t earlier = 0;; ++earlier) {
        const std::uint64_t count =
            wholeNumber(lines, lines.next("its number of particles"), "the number of particles");
        const std::string_view comment = lines.next("its line of properties");
        TextLines rows = lines;
        skipLines(lines, count);
        if (!lines.isAtEnd()) continue;
        ParticleTable table = readParticles(rows, count, comment);
        if (earlier > 0) table.skipped.push_back(fmt::format("{} frames before the last", earlier));
        return table;
    }
}

}  // namespace scenes
