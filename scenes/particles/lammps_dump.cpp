// A dump is a sequence of snapshots. Each is a number of items, "ITEM: NAME" and the lines that belong to it, of which
// ATOMS is the last.
#include "scenes/particles/lammps_dump.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/core/bounding_box.h"
#include "scenes/particles/text_rows.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::string_view kItem = "ITEM: ";

/// What stands before the atoms of a snapshot.
struct SnapshotHeader {
    std::string timeStep;
    std::string units;
    std::optional<std::uint64_t> atomCount;
    std::array<double, 3> low{}, high{};  ///< corners of the box
    bool isBoxKnown = false;
    bool isTriclinic = false;
    std::vector<std::string_view> columns;
};

void readBox(TextLines& lines, std::string_view flags, SnapshotHeader& header) {
    header.isTriclinic = splitWords(flags).size() != 3 && !splitWords(flags).empty();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::string_view line = lines.next("the bounds of its box");
        header.low[axis] = realNumber(lines, takeWord(line), "the lower bound");
        header.high[axis] = realNumber(lines, takeWord(line), "the upper bound");
    }
    header.isBoxKnown = true;
}

SnapshotHeader readSnapshotHeader(TextLines& lines) {
    SnapshotHeader header;
    while (true) {
        std::string_view line = lines.next("ITEM: ATOMS");
        if (splitWords(line).empty()) continue;
        if (!line.starts_with(kItem))
            lines.fail("must be an ITEM: there are more lines than atoms, or a line is damaged");
        line.remove_prefix(kItem.size());
        if (line.starts_with("ATOMS")) {
            header.columns = splitWords(line.substr(5));
            if (!header.atomCount) lines.fail("ITEM: ATOMS without ITEM: NUMBER OF ATOMS before it");
            return header;
        }
        if (line.starts_with("NUMBER OF ATOMS"))
            header.atomCount = wholeNumber(lines, lines.next("its number of atoms"), "the number of atoms");
        else if (line.starts_with("BOX BOUNDS"))
            readBox(lines, line.substr(10), header);
        else if (line.starts_with("TIMESTEP"))
            header.timeStep = lines.next("its time step");
        else if (line.starts_with("UNITS"))
            header.units = lines.next("its units");
        else if (line.starts_with("TIME"))
            lines.next("its time");
        else
            lines.fail(fmt::format("unknown ITEM: {}", line.substr(0, 40)));
    }
}

/// How the positions of a dump are called, and whether they are shares of the box.
struct PositionNames {
    std::array<std::string_view, 3> names;
    bool isScaled;
};

constexpr std::array<PositionNames, 4> kPositionNames = {
    {{{"x", "y", "z"}, false}, {{"xu", "yu", "zu"}, false}, {{"xs", "ys", "zs"}, true}, {{"xsu", "ysu", "zsu"}, true}}};

const PositionNames& positionNames(const TextLines& lines, const SnapshotHeader& header) {
    for (const PositionNames& each : kPositionNames)
        if (std::ranges::all_of(each.names, [&](std::string_view name) {
                return std::ranges::find(header.columns, name) != header.columns.end();
            })) {
            if (each.isScaled && (header.isTriclinic || !header.isBoxKnown))
                lines.fail("scaled positions need an orthogonal box; dump x y z instead");
            return each;
        }
    lines.fail("ITEM: ATOMS has no columns x y z (nor xu yu zu, xs ys zs)");
}

/// What a column of the dump is called in the table; empty if it is not read.
std::string_view meaningOf(std::string_view name, const PositionNames& positions) {
    constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
    const auto* const axis = std::ranges::find(positions.names, name);
    if (axis != positions.names.end()) return kAxes.at(static_cast<std::size_t>(axis - positions.names.begin()));
    if (name == "type") return "material";
    if (name == "diameter") return "radius";
    constexpr std::array<std::string_view, 5> kSame = {"vx", "vy", "vz", "radius", "mass"};
    return std::ranges::find(kSame, name) != kSame.end() ? name : "";
}

/// Brings the numbers of the dump into those of the table: types count from 1, diameters are twice the radius, scaled
/// positions are shares of the box.
void convert(const SnapshotHeader& header, const PositionNames& positions, const std::vector<std::string_view>& origins,
             ParticleTable& table) {
    for (std::size_t index = 0; index < origins.size(); ++index) {
        std::vector<double>& values = table.columns[index].values;
        const auto* const axis = std::ranges::find(positions.names, origins[index]);
        if (origins[index] == "type")
            for (double& value : values) value -= 1.0;
        else if (origins[index] == "diameter")
            for (double& value : values) value /= 2.0;
        else if (positions.isScaled && axis != positions.names.end()) {
            const auto which = static_cast<std::size_t>(axis - positions.names.begin());
            for (double& value : values) value = header.low[which] + value * (header.high[which] - header.low[which]);
        }
    }
}

ParticleTable readAtoms(TextLines& lines, const SnapshotHeader& header) {
    ParticleTable table;
    const PositionNames& positions = positionNames(lines, header);
    table.columns.reserve(header.columns.size());  // so that pointers to columns stay valid
    std::vector<std::string_view> origins;
    std::vector<TextColumn> columns;
    for (const std::string_view name : header.columns) {
        TextColumn& column = columns.emplace_back(TextColumn{std::string(name)});
        const std::string_view meaning = meaningOf(name, positions);
        if (meaning.empty()) {
            if (name != "id") table.skipped.emplace_back(name);
            continue;
        }
        if (table.column(meaning) != nullptr) lines.fail(fmt::format("column {} is given twice", meaning));
        column.values = &table.columns.emplace_back(NumberColumn{std::string(meaning), {}}).values;
        origins.push_back(name);
    }
    readTextRows(lines, *header.atomCount, columns, table);
    convert(header, positions, origins, table);
    if (!header.units.empty() && header.units != "si") table.skipped.push_back("units " + header.units.substr(0, 40));
    return table;
}

/// The extent of the particles; a box around the origin if there are none.
engine::BoundingBox extentOf(const engine::Particles& particles) {
    if (particles.count() == 0) return {engine::Vec3::Constant(-1.0), engine::Vec3::Constant(1.0)};
    engine::BoundingBox box{particles.position[0], particles.position[0]};
    for (std::size_t index = 0; index < particles.count(); ++index) {
        const engine::Vec3 reach = engine::Vec3::Constant(particles.radius[index]);
        box.low = box.low.cwiseMin(particles.position[index] - reach);
        box.high = box.high.cwiseMax(particles.position[index] + reach);
    }
    return box;
}

}  // namespace

std::string encodeLammpsDump(const ParticleFrame& frame) {
    const engine::Particles& particles = frame.particles;
    const engine::BoundingBox box = extentOf(particles);
    // LAMMPS reads units and time only before the time step.
    std::string text = fmt::format("ITEM: UNITS\nsi\nITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n",
                                   frame.stamp.time, frame.stamp.frame, particles.count());
    text += "ITEM: BOX BOUNDS ff ff ff\n";
    for (int axis = 0; axis < 3; ++axis) text += fmt::format("{} {}\n", box.low[axis], box.high[axis]);
    text += "ITEM: ATOMS id type x y z vx vy vz radius mass\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        text +=
            fmt::format("{} {}", std::uint64_t{particles.id[index]} + 1, std::uint64_t{particles.material[index]} + 1);
        const auto put = [&](double number) {
            text += ' ';
            putNumber(text, number);
        };
        for (const engine::Vec3& vector : {particles.position[index], particles.velocity[index]})
            for (int axis = 0; axis < 3; ++axis) put(vector[axis]);
        put(particles.radius[index]);
        put(particles.mass[index]);
        text += '\n';
    }
    return text;
}

bool isLammpsDump(std::string_view bytes) {
    return bytes.starts_with(kItem);
}

ParticleTable readLammpsDump(std::string_view bytes, const std::string& fileName) {
    TextLines lines(bytes, fileName);
    for (std::uint64_t earlier = 0;; ++earlier) {
        const SnapshotHeader header = readSnapshotHeader(lines);
        TextLines rows = lines;
        skipLines(lines, *header.atomCount);
        if (!lines.isAtEnd()) continue;
        ParticleTable table = readAtoms(rows, header);
        if (earlier > 0)
            table.skipped.push_back(fmt::format("{} snapshots before the last, which is that of time step {}", earlier,
                                                header.timeStep.substr(0, 20)));
        return table;
    }
}

}  // namespace scenes
