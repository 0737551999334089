// A strict reader: whatever is not known is refused, because a particle in the wrong place is harder to notice than a
// message.
#include "scenes/model/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "scenes/text/input_error.h"

namespace scenes {
namespace {

/// No header of ours is a tenth as long, bytes.
constexpr std::size_t kLongestHeader = 65536;

const std::vector<std::pair<std::string_view, PlyType>> kTypes = {
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}, {"uchar", PlyType::uint8},     {"uint8", PlyType::uint8},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32}};

const std::vector<std::string_view> kReals = {"x", "y", "z", "vx", "vy", "vz", "radius", "mass"};
const std::vector<std::string_view> kIndices = {"material", "id"};

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The header while it is read.
struct Reading {
    std::string_view bytes;
    const std::string& fileName;
    PlyHeader header = {};
    int line = 0;
    bool hasFormat = false;
    bool hasElement = false;
};

[[noreturn]] void fail(const Reading& reading, const std::string& message) {
    throw InputError({{reading.fileName, reading.line, reading.line > 0 ? 1 : 0, message}});
}

std::string nextLine(Reading& reading) {
    ++reading.line;
    const std::string_view rest = reading.bytes.substr(reading.header.size);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos || reading.header.size + end > kLongestHeader)
        fail(reading, "the header has no end_header");
    reading.header.size += end + 1;
    std::string line(rest.substr(0, end));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words;
    for (std::size_t at = line.find_first_not_of(' '); at != std::string::npos; at = line.find_first_not_of(' ', at)) {
        const std::size_t end = std::min(line.find(' ', at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

void readElement(Reading& reading, const std::vector<std::string>& words) {
    if (words.size() != 3 || words[1] != "vertex" || reading.hasElement)
        fail(reading, "must have the one element \"vertex\" and its count");
    const std::string& digits = words[2];
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), reading.header.count);
    if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size())
        fail(reading, fmt::format("the count of vertices is \"{}\", must be a whole number", digits));
    reading.hasElement = true;
}

void readProperty(Reading& reading, const std::vector<std::string>& words) {
    if (!reading.hasElement) fail(reading, "a property stands before its element");
    if (words.size() != 3) fail(reading, "a property must be a type and a name; lists are not supported");
    const auto type =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& known) { return known.first == words[1]; });
    const std::string& name = words[2];
    if (!contains(kReals, name) && !contains(kIndices, name))
        fail(reading, fmt::format("unknown property \"{}\" (known: {}, {})", name, fmt::join(kReals, ", "),
                                  fmt::join(kIndices, ", ")));
    if (reading.header.has(name)) fail(reading, fmt::format("property \"{}\" is given twice", name));
    const bool isReal = type != kTypes.end() && (type->second == PlyType::float32 || type->second == PlyType::float64);
    if (type == kTypes.end() || isReal != contains(kReals, name))
        fail(reading, fmt::format("property \"{}\" has type {}, must be {}", name, words[1],
                                  contains(kReals, name) ? "float or double" : "uchar, ushort or uint"));
    reading.header.properties.push_back({name, type->second});
}

void readStatement(Reading& reading, const std::vector<std::string>& words) {
    if (words[0] == "format") {
        if (words != std::vector<std::string>{"format", "binary_little_endian", "1.0"})
            fail(reading, "the format must be \"binary_little_endian 1.0\"");
        reading.hasFormat = true;
    } else if (words[0] == "element") {
        readElement(reading, words);
    } else if (words[0] == "property") {
        readProperty(reading, words);
    } else if (words[0] != "comment" && words[0] != "obj_info") {
        fail(reading, fmt::format("unknown header line \"{}\"", words[0].substr(0, 40)));
    }
}

void checkComplete(Reading& reading) {
    reading.line = 0;
    const PlyHeader& header = reading.header;
    if (!reading.hasFormat) fail(reading, "the header has no format line");
    if (!reading.hasElement) fail(reading, "the header has no element \"vertex\"");
    for (const char* name : {"x", "y", "z"})
        if (!header.has(name)) fail(reading, fmt::format("property \"{}\" is missing", name));
    if (header.has("vx") != header.has("vy") || header.has("vx") != header.has("vz"))
        fail(reading, "velocities need all of vx, vy and vz");
}

/// The rows must fill the file exactly. Divides instead of multiplying, so that no count overflows.
void checkLength(Reading& reading) {
    std::size_t stride = 0;
    for (const PlyProperty& property : reading.header.properties) stride += sizeOf(property.type);
    const std::size_t rest = reading.bytes.size() - reading.header.size;
    if (reading.header.count > rest / stride)
        fail(reading, fmt::format("truncated: {} particles of {} bytes are announced, {} bytes follow",
                                  reading.header.count, stride, rest));
    if (rest != reading.header.count * stride)
        fail(reading, fmt::format("{} bytes follow the last particle", rest - reading.header.count * stride));
}

}  // namespace

std::size_t sizeOf(PlyType type) {
    switch (type) {
        case PlyType::uint8:
            return 1;
        case PlyType::uint16:
            return 2;
        case PlyType::float32:
        case PlyType::uint32:
            return 4;
        case PlyType::float64:
            break;
    }
    return 8;
}

bool PlyHeader::has(std::string_view name) const {
    return std::any_of(properties.begin(), properties.end(),
                       [&](const PlyProperty& property) { return property.name == name; });
}

PlyHeader readPlyHeader(std::string_view bytes, const std::string& fileName) {
    Reading reading{bytes, fileName};
    if (bytes.substr(0, 3) != "ply" || nextLine(reading) != "ply") {
        reading.line = 0;
        fail(reading, "is not a PLY file");
    }
    while (true) {
        const std::vector<std::string> words = wordsOf(nextLine(reading));
        if (words.empty()) continue;
        if (words[0] == "end_header") break;
        readStatement(reading, words);
    }
    checkComplete(reading);
    checkLength(reading);
    return reading.header;
}

}  // namespace scenes
