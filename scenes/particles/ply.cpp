// A PLY file is a header of text lines and then the rows of its elements, one after the other. The header names the
// properties of each element; a row has a number, or a list of numbers, for each of them.
#include "scenes/particles/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "scenes/particles/number_type.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

enum class Encoding { text, littleEndian, bigEndian };

/// A type that numbers of a PLY file may have.
struct NamedType {
    std::string_view name;
    std::string_view otherName;  ///< as some programs write it
    NumberType number;
};

constexpr std::array<NamedType, 8> kTypes = {{{"char", "int8", numberType<std::int8_t>()},
                                              {"uchar", "uint8", numberType<std::uint8_t>()},
                                              {"short", "int16", numberType<std::int16_t>()},
                                              {"ushort", "uint16", numberType<std::uint16_t>()},
                                              {"int", "int32", numberType<std::int32_t>()},
                                              {"uint", "uint32", numberType<std::uint32_t>()},
                                              {"float", "float32", numberType<float>()},
                                              {"double", "float64", numberType<double>()}}};

struct Property {
    std::string name;
    const NumberType* type = nullptr;
    const NumberType* lengthType = nullptr;  ///< type of a list's length; nullptr for a single number
};

struct Element {
    std::string name;
    std::uint64_t rowCount = 0;
    std::vector<Property> properties;
};

struct Header {
    std::optional<Encoding> encoding;
    std::vector<Element> elements;
    std::vector<std::string> comments;
};

/// A PLY file while it is read.
struct Reader {
    std::string_view bytes;
    const std::string& fileName;
    std::size_t at = 0;   ///< number of bytes of the file that have been read
    int line = 0;         ///< of the header, from 1
    char lineEnd = '\n';  ///< last character of a line; '\r' in files of old Macintosh programs
    Encoding encoding = Encoding::text;
};

[[noreturn]] void failInHeader(const Reader& reader, const std::string& message) {
    throw InputError({{reader.fileName, reader.line, 1, message}});
}

std::string nextLine(Reader& reader) {
    constexpr std::size_t kMaxHeaderBytes = 65536;  // largest size of a header; chosen: ten times the longest known
    ++reader.line;
    const std::size_t end = reader.bytes.find(reader.lineEnd, reader.at);
    if (end == std::string_view::npos || end > kMaxHeaderBytes) failInHeader(reader, "the header has no end_header");
    std::string line(reader.bytes.substr(reader.at, end - reader.at));
    reader.at = end + 1;
    return line;
}

std::vector<std::string> wordsOf(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

Encoding encodingOf(const Reader& reader, const std::vector<std::string>& words) {
    constexpr std::array<std::string_view, 3> kNames = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto* const name = words.size() == 3 ? std::ranges::find(kNames, words[1]) : kNames.end();
    if (name == kNames.end() || words[2] != "1.0")
        failInHeader(reader, fmt::format("the format must be {} 1.0", fmt::join(kNames, ", ")));
    return static_cast<Encoding>(name - kNames.begin());
}

Element elementOf(const Reader& reader, const std::vector<std::string>& words) {
    if (words.size() != 3) failInHeader(reader, "an element must be a name and a count");
    Element element{words[1], 0, {}};
    const std::string& digits = words[2];
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), element.rowCount);
    if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size())
        failInHeader(reader, fmt::format("the count is \"{}\", must be a whole number", digits));
    return element;
}

const NumberType* typeOf(const Reader& reader, const std::string& name) {
    const auto* const type =
        std::ranges::find_if(kTypes, [&](const NamedType& one) { return one.name == name || one.otherName == name; });
    if (type == kTypes.end()) failInHeader(reader, fmt::format("unknown type \"{}\"", name));
    return &type->number;
}

Property propertyOf(const Reader& reader, const std::vector<std::string>& words) {
    if (words.size() == 3) return {words[2], typeOf(reader, words[1]), nullptr};
    if (words.size() == 5 && words[1] == "list") return {words[4], typeOf(reader, words[3]), typeOf(reader, words[2])};
    failInHeader(reader, "a property must be a type and a name, or a list");
}

void readStatement(const Reader& reader, const std::vector<std::string>& words, Header& header) {
    const std::string& first = words[0];
    if (first == "format") {
        header.encoding = encodingOf(reader, words);
    } else if (first == "element") {
        header.elements.push_back(elementOf(reader, words));
    } else if (first == "property") {
        if (header.elements.empty()) failInHeader(reader, "property before its element");
        header.elements.back().properties.push_back(propertyOf(reader, words));
    } else if (first == "comment") {
        header.comments.push_back(fmt::format("{}", fmt::join(words.begin() + 1, words.end(), " ")));
    } else if (first != "obj_info") {
        failInHeader(reader, fmt::format("unknown header line \"{}\"", first.substr(0, 40)));
    }
}

Header readHeader(Reader& reader) {
    if (reader.bytes.substr(0, 4) == "ply\r" && reader.bytes.substr(4, 1) != "\n") reader.lineEnd = '\r';
    if (reader.bytes.substr(0, 3) != "ply" || wordsOf(nextLine(reader)) != std::vector<std::string>{"ply"})
        throw InputError(reader.fileName, "is not a PLY file");
    Header header;
    while (true) {
        const std::vector<std::string> words = wordsOf(nextLine(reader));
        if (words.empty()) continue;
        if (words[0] == "end_header") break;
        readStatement(reader, words, header);
    }
    if (!header.encoding) throw InputError(reader.fileName, "the header has no format line");
    return header;
}

/// The next word of the rows of a text file; empty at the end of the file.
std::string_view nextWord(Reader& reader) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t begin = std::min(reader.bytes.find_first_not_of(kBlanks, reader.at), reader.bytes.size());
    reader.at = std::min(reader.bytes.find_first_of(kBlanks, begin), reader.bytes.size());
    return reader.bytes.substr(begin, reader.at - begin);
}

/// Where in the file a number stands, for messages.
struct Place {
    const Element& element;
    std::uint64_t row;
    const Property& property;
};

[[noreturn]] void failAt(const Reader& reader, const Place& place, const std::string& message) {
    throw InputError(reader.fileName, fmt::format("{} {} of {}: {} {}", place.element.name, place.row,
                                                  place.element.rowCount, place.property.name, message));
}

double nextNumber(Reader& reader, const NumberType& type, const Place& place) {
    constexpr const char* kMissing = "is missing, the file ends before it";
    if (reader.encoding == Encoding::text) {
        const std::string_view word = nextWord(reader);
        if (word.empty()) failAt(reader, place, kMissing);
        double number = 0.0;
        const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
        if (result.ec != std::errc{} || result.ptr != word.data() + word.size())
            failAt(reader, place, fmt::format("is \"{}\", must be a number", word.substr(0, 40)));
        return number;
    }
    if (reader.bytes.size() - reader.at < type.size) failAt(reader, place, kMissing);
    std::array<char, sizeof(double)> number{};
    const auto bytes = std::span(number).first(type.size);
    std::copy_n(reader.bytes.data() + reader.at, type.size, bytes.begin());
    if (reader.encoding == Encoding::bigEndian) std::ranges::reverse(bytes);
    reader.at += type.size;
    return type.decode(number.data());
}

/// Reads all rows of an element.
/// @param columns  where the numbers of each property go; nullptr where they are skipped
void readRows(Reader& reader, const Element& element, std::span<std::vector<double>* const> columns) {
    if (element.properties.empty()) return;  // its rows have no bytes
    for (std::uint64_t row = 0; row < element.rowCount; ++row) {
        for (std::size_t index = 0; index < element.properties.size(); ++index) {
            const Property& property = element.properties[index];
            const Place place{element, row, property};
            if (property.lengthType != nullptr) {
                const double length = nextNumber(reader, *property.lengthType, place);
                for (double item = 0.0; item < length; ++item) nextNumber(reader, *property.type, place);
            } else {
                const double number = nextNumber(reader, *property.type, place);
                if (columns[index] != nullptr) columns[index]->push_back(number);
            }
        }
    }
}

void skipRows(Reader& reader, const Element& element) {
    readRows(reader, element, std::vector<std::vector<double>*>(element.properties.size(), nullptr));
}

/// Reads the vertices, and lists in `vertices.skipped` the properties that are not wanted.
void readVertices(Reader& reader, const Element& element, std::span<const std::string_view> wanted,
                  ParticleTable& vertices) {
    vertices.count = element.rowCount;
    vertices.columns.reserve(element.properties.size());  // so that pointers to columns stay valid
    std::vector<std::vector<double>*> columns;
    for (const Property& property : element.properties) {
        columns.push_back(nullptr);
        if (std::ranges::find(wanted, property.name) == wanted.end()) {
            vertices.skipped.push_back(property.name);
            continue;
        }
        if (property.lengthType != nullptr)
            throw InputError(reader.fileName,
                             fmt::format("property \"{}\" is a list, must be a number", property.name));
        if (vertices.column(property.name) != nullptr)
            throw InputError(reader.fileName, fmt::format("property \"{}\" is given twice", property.name));
        columns.back() = &vertices.columns.emplace_back(NumberColumn{property.name, {}}).values;
    }
    readRows(reader, element, columns);
}

}  // namespace

bool isPly(std::string_view bytes) {
    return bytes.starts_with("ply");
}

ParticleTable readPlyVertices(std::string_view bytes, const std::string& fileName,
                              std::span<const std::string_view> wanted) {
    Reader reader{bytes, fileName};
    Header header = readHeader(reader);
    reader.encoding = *header.encoding;
    const auto isVertex = [](const Element& element) { return element.name == "vertex"; };
    if (std::ranges::count_if(header.elements, isVertex) != 1)
        throw InputError(fileName, "the header must have one element \"vertex\"");
    ParticleTable vertices;
    vertices.comments = std::move(header.comments);
    bool isRead = false;
    for (const Element& element : header.elements) {
        if (isVertex(element)) {
            readVertices(reader, element, wanted, vertices);
            isRead = true;
        } else {
            if (element.rowCount > 0) vertices.skipped.push_back("element " + element.name);
            if (!isRead) skipRows(reader, element);  // rows after the vertices need not be read
        }
    }
    const std::size_t left = bytes.size() - reader.at;
    const bool isBlank = bytes.find_first_not_of(" \t\r\n", reader.at) == std::string_view::npos;
    if (isVertex(header.elements.back()) && left > 0 && !(reader.encoding == Encoding::text && isBlank))
        vertices.skipped.push_back(fmt::format("{} bytes at the end", left));
    return vertices;
}

}  // namespace scenes
