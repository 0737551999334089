// First the XML is read up to the appended data, then the numbers of the arrays that are wanted. No memory is taken for
// numbers that the file does not have.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>

#include "scenes/particles/number_type.h"
#include "scenes/particles/text_rows.h"
#include "scenes/particles/vtp.h"
#include "scenes/particles/xml_tags.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

struct VtkType {
    std::string_view name;
    NumberType type;
};

constexpr std::array<VtkType, 10> kVtkTypes = {{{"Int8", numberType<std::int8_t>()},
                                                {"UInt8", numberType<std::uint8_t>()},
                                                {"Int16", numberType<std::int16_t>()},
                                                {"UInt16", numberType<std::uint16_t>()},
                                                {"Int32", numberType<std::int32_t>()},
                                                {"UInt32", numberType<std::uint32_t>()},
                                                {"Int64", numberType<std::int64_t>()},
                                                {"UInt64", numberType<std::uint64_t>()},
                                                {"Float32", numberType<float>()},
                                                {"Float64", numberType<double>()}}};

/// Names of the data that are read, in lower case, and their columns.
struct VtpMeaning {
    std::string_view name;
    std::array<std::string_view, 3> columns;
};

constexpr std::array<VtpMeaning, 7> kVtpMeanings = {{{"velocity", {"vx", "vy", "vz"}},
                                                     {"velocities", {"vx", "vy", "vz"}},
                                                     {"vel", {"vx", "vy", "vz"}},
                                                     {"radius", {"radius"}},
                                                     {"mass", {"mass"}},
                                                     {"material", {"material"}},
                                                     {"temperature", {"temperature"}}}};

/// Data that mean nothing to a new simulation.
constexpr std::array<std::string_view, 3> kVtpIgnored = {"id", "color", "birth_time"};

constexpr std::string_view kFileEnd = "</VTKFile>";
constexpr const char* kCutShort = "the file ends before </VTKFile>";

/// An array of numbers, not yet read.
struct DataArray {
    XmlTag tag;
    std::string_view name;
    std::size_t componentCount = 1;
    NumberType type{};
};

/// A file while it is read.
struct VtpReader {
    std::string_view bytes;
    XmlTags tags;
    bool isFile = false;          ///< whether the tag of the whole file has been read
    bool hasPiece = false;        ///< whether that of the points has
    std::size_t headerBytes = 4;  ///< size of the number before binary data
    bool isBigEndian = false;
    bool isCompressed = false;  ///< whether data that are not ASCII are
    std::size_t pointCount = 0;
    std::optional<DataArray> points{};
    std::vector<DataArray> data{};  ///< those of the points
    std::size_t appendedAt = 0;     ///< index of the first appended byte; 0 if there are none
    bool isAppendedBase64 = false;
};

/// What messages call an array.
std::string_view nameOf(const DataArray& array) {
    return array.name.empty() ? "an array without a name" : array.name.substr(0, 40);
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return lower;
}

std::uint64_t numberIn(const VtpReader& reader, const XmlTag& tag, std::string_view attribute,
                       std::string_view fallback) {
    const std::string_view text = tag.value(attribute, fallback);
    std::uint64_t number = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
        reader.tags.fail(tag.line, fmt::format("{} is \"{}\", must be a whole number", attribute, text.substr(0, 40)));
    return number;
}

void readFileTag(VtpReader& reader, const XmlTag& tag) {
    const std::string_view type = tag.value("type");
    if (type != "PolyData")
        reader.tags.fail(tag.line, fmt::format("holds {}, must hold PolyData (.vtp)", type.substr(0, 40)));
    reader.isFile = true;
    reader.isCompressed = !tag.value("compressor").empty();
    reader.headerBytes = tag.value("header_type") == "UInt64" ? 8 : 4;
    reader.isBigEndian = tag.value("byte_order") == "BigEndian";
}

DataArray arrayOf(const VtpReader& reader, const XmlTag& tag) {
    DataArray array{tag, tag.value("Name"), numberIn(reader, tag, "NumberOfComponents", "1")};
    const auto* const type = std::ranges::find(kVtkTypes, tag.value("type"), &VtkType::name);
    if (type == kVtkTypes.end())
        reader.tags.fail(tag.line,
                         fmt::format("type is \"{}\", must be a number type", tag.value("type").substr(0, 40)));
    array.type = type->type;
    return array;
}

void readPieceTag(VtpReader& reader, const XmlTag& tag) {
    if (reader.hasPiece) reader.tags.fail(tag.line, "has several pieces; save it as one");
    reader.hasPiece = true;
    const std::uint64_t count = numberIn(reader, tag, "NumberOfPoints", "");
    // A point takes three bytes at least.
    if (count > reader.bytes.size())
        reader.tags.fail(tag.line, fmt::format("has {} bytes, too few for {} points", reader.bytes.size(), count));
    reader.pointCount = count;
}

void readAppendedTag(VtpReader& reader, const XmlTag& tag) {
    reader.isAppendedBase64 = tag.value("encoding") == "base64";
    const std::size_t mark = reader.bytes.find('_', tag.textAt);
    if (mark == std::string_view::npos) reader.tags.fail(tag.line, "AppendedData has no \"_\" before the data");
    reader.appendedAt = mark + 1;
    const std::size_t end = reader.bytes.find_last_not_of(" \t\r\n");
    if (!reader.bytes.substr(0, end + 1).ends_with(kFileEnd)) reader.tags.fail(0, kCutShort);
}

/// Reads the tags up to the appended data, or to the end of a file that has none.
void readTags(VtpReader& reader) {
    XmlTag tag;
    std::string_view section;  // the part of the piece that arrays belong to
    while (reader.tags.next(tag)) {
        if (!reader.isFile && (tag.name != "VTKFile" || tag.isEnd)) reader.tags.fail(tag.line, "is not a VTK file");
        if (tag.name == "VTKFile") {
            if (tag.isEnd) return;
            readFileTag(reader, tag);
        } else if (tag.name == "AppendedData") {
            return readAppendedTag(reader, tag);
        } else if (tag.name == "Piece" && !tag.isEnd) {
            readPieceTag(reader, tag);
        } else if (tag.name == "Points" || tag.name == "PointData") {
            section = tag.isEnd || tag.isEmpty ? std::string_view() : tag.name;
        } else if (tag.name != "DataArray" || tag.isEnd) {
            continue;
        } else if (section == "Points") {
            reader.points = arrayOf(reader, tag);
        } else if (section == "PointData" && tag.value("type") != "String") {
            reader.data.push_back(arrayOf(reader, tag));
        }
    }
    reader.tags.fail(0, kCutShort);
}

/// Value of a base64 digit; -1 for any other character.
int digitOf(char letter) {
    if ('A' <= letter && letter <= 'Z') return letter - 'A';
    if ('a' <= letter && letter <= 'z') return letter - 'a' + 26;
    if ('0' <= letter && letter <= '9') return letter - '0' + 52;
    return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

/// The bytes of base64 text up to its end or the first character that is none of it. The length before the data may be
/// padded on its own, so padding may come in the middle.
/// @param limit  no more bytes than this, or one or two more, are returned
std::string fromBase64(std::string_view text, std::size_t limit) {
    std::string bytes;
    std::array<int, 4> group{};
    std::size_t digitCount = 0;
    std::size_t paddingCount = 0;
    for (const char letter : text) {
        if (std::isspace(static_cast<unsigned char>(letter)) != 0) continue;
        const int digit = digitOf(letter);
        if (letter != '=' && digit < 0) break;
        paddingCount += letter == '=' ? 1 : 0;
        group.at(digitCount++) = std::max(digit, 0);
        if (digitCount < 4) continue;
        const int all = group[0] << 18 | group[1] << 12 | group[2] << 6 | group[3];
        for (std::size_t index = 0; index + paddingCount < 3; ++index)
            bytes += static_cast<char>(all >> (16 - 8 * static_cast<int>(index)) & 0xFF);
        digitCount = paddingCount = 0;
        if (bytes.size() >= limit) break;
    }
    return bytes;
}

/// The numbers of a binary array, which stand after their length in bytes.
std::vector<double> decodeBinary(const VtpReader& reader, const DataArray& array, std::string_view bytes) {
    const std::size_t count = reader.pointCount * array.componentCount;
    if (bytes.size() < reader.headerBytes)
        reader.tags.fail(array.tag.line, fmt::format("{}: the file ends before its data", nameOf(array)));
    const auto decoded = [&](std::size_t at, const NumberType& type) {
        std::array<char, 8> number{};
        const auto digits = std::span(number).first(type.size);
        std::copy_n(bytes.data() + at, type.size, digits.begin());
        if (reader.isBigEndian) std::ranges::reverse(digits);
        return type.decode(number.data());
    };
    const double length =
        decoded(0, reader.headerBytes == 8 ? numberType<std::uint64_t>() : numberType<std::uint32_t>());
    if (length != static_cast<double>(count * array.type.size))
        reader.tags.fail(array.tag.line,
                         fmt::format("{}: has {} bytes, must have {}", nameOf(array), length, count * array.type.size));
    if ((bytes.size() - reader.headerBytes) / array.type.size < count)
        reader.tags.fail(array.tag.line, fmt::format("{}: the file ends before its data do", nameOf(array)));
    std::vector<double> values(count);
    for (std::size_t index = 0; index < count; ++index)
        values[index] = decoded(reader.headerBytes + index * array.type.size, array.type);
    return values;
}

/// The numbers of an array as text.
std::vector<double> decodeText(const VtpReader& reader, const DataArray& array, std::string_view text) {
    const std::size_t count = reader.pointCount * array.componentCount;
    std::vector<double> values;
    constexpr std::string_view kBlanks = " \t\r\n";
    std::size_t at = 0;
    while (values.size() < count) {
        const std::size_t begin = std::min(text.find_first_not_of(kBlanks, at), text.size());
        at = std::min(text.find_first_of(" \t\r\n<", begin), text.size());
        const std::string_view word = text.substr(begin, at - begin);
        double value = 0.0;
        const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
        if (result.ec != std::errc{} || result.ptr != word.data() + word.size())
            reader.tags.fail(array.tag.line, fmt::format("{}: number {} of {} is \"{}\", must be a number", array.name,
                                                         values.size(), count, word.substr(0, 40)));
        values.push_back(value);
    }
    return values;
}

/// The numbers of an array, those of a point after those of the one before.
std::vector<double> numbersOf(const VtpReader& reader, const DataArray& array) {
    const std::string_view format = array.tag.value("format", "ascii");
    // An empty tag has no text.
    const std::string_view text = array.tag.isEmpty ? std::string_view() : reader.bytes.substr(array.tag.textAt);
    if (format == "ascii") return decodeText(reader, array, text);
    if (reader.isCompressed)
        reader.tags.fail(
            array.tag.line,
            fmt::format("{}: is compressed; save it without compression (in ParaView's \"Configure Writer\" "
                        "set Compressor Type to None, in VTK call SetCompressorTypeToNone)",
                        nameOf(array)));
    const std::size_t byteCount = reader.headerBytes + reader.pointCount * array.componentCount * array.type.size;
    if (format == "binary") return decodeBinary(reader, array, fromBase64(text, byteCount));
    if (format != "appended")
        reader.tags.fail(array.tag.line, fmt::format("format \"{}\" is unknown", format.substr(0, 40)));
    const std::uint64_t offset = numberIn(reader, array.tag, "offset", "");
    if (reader.appendedAt == 0) reader.tags.fail(array.tag.line, "the file has no AppendedData");
    if (offset > reader.bytes.size() - reader.appendedAt)
        reader.tags.fail(array.tag.line, fmt::format("{}: the file ends before its data", nameOf(array)));
    const std::string_view data = reader.bytes.substr(reader.appendedAt + offset);
    if (!reader.isAppendedBase64) return decodeBinary(reader, array, data);
    return decodeBinary(reader, array, fromBase64(data, byteCount));
}

/// Appends the columns of an array to the table.
void addColumns(const VtpReader& reader, const DataArray& array, const std::array<std::string_view, 3>& names,
                ParticleTable& table) {
    const auto expected =
        static_cast<std::size_t>(std::ranges::count_if(names, [](std::string_view name) { return !name.empty(); }));
    if (array.componentCount != expected)
        reader.tags.fail(array.tag.line, fmt::format("{} has {} components, must have {}", nameOf(array),
                                                     array.componentCount, expected));
    if (table.column(names[0]) != nullptr)
        reader.tags.fail(array.tag.line, fmt::format("{} is given twice", nameOf(array)));
    const std::vector<double> numbers = reader.pointCount > 0 ? numbersOf(reader, array) : std::vector<double>();
    for (std::size_t component = 0; component < expected; ++component) {
        NumberColumn& column = table.columns.emplace_back(NumberColumn{std::string(names.at(component)), {}});
        column.values.reserve(reader.pointCount);
        for (std::size_t at = component; at < numbers.size(); at += expected) column.values.push_back(numbers[at]);
    }
}

}  // namespace

bool isXml(std::string_view bytes) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    return begin != std::string_view::npos && bytes[begin] == '<';
}

ParticleTable readVtp(std::string_view bytes, const std::string& fileName) {
    VtpReader reader{bytes, XmlTags(bytes, fileName)};
    readTags(reader);
    if (!reader.hasPiece) throw InputError(fileName, "has no Piece");
    ParticleTable table;
    table.count = reader.pointCount;
    if (reader.points)
        addColumns(reader, *reader.points, {"x", "y", "z"}, table);
    else if (reader.pointCount > 0)
        throw InputError(fileName, "has no Points");
    else
        for (const char* name : {"x", "y", "z"}) table.columns.push_back({name, {}});
    for (const DataArray& array : reader.data) {
        const std::string name = lowerCase(array.name);
        const auto* const meaning = std::ranges::find(kVtpMeanings, name, &VtpMeaning::name);
        if (meaning != kVtpMeanings.end())
            addColumns(reader, array, meaning->columns, table);
        else if (std::ranges::find(kVtpIgnored, name) == kVtpIgnored.end())
            table.skipped.emplace_back(nameOf(array));
    }
    return table;
}

}  // namespace scenes
