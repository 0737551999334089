// Words are separated by blanks and tabs; lines end with "\n" or "\r\n".
#include "scenes/particles/text_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::string_view kWordBlanks = " \t\r";

/// The beginning of a word, for messages.
std::string_view shown(std::string_view word) {
    return word.substr(0, 40);
}

template <class Number>
void putShortest(std::string& text, Number number) {
    std::array<char, 32> digits{};
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

}  // namespace

std::string_view TextLines::next(std::string_view expected) {
    ++line_;
    if (at_ >= bytes_.size()) fail(fmt::format("the file ends before {}", expected));
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

bool TextLines::isAtEnd() const {
    return at_ >= bytes_.size() || bytes_.find_first_not_of(" \t\r\n", at_) == std::string_view::npos;
}

void TextLines::fail(const std::string& message) const {
    throw InputError({{*fileName_, line_, 0, message}});
}

std::string_view takeWord(std::string_view& text) {
    const std::size_t begin = std::min(text.find_first_not_of(kWordBlanks), text.size());
    const std::size_t end = std::min(text.find_first_of(kWordBlanks, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

std::vector<std::string_view> splitWords(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) words.push_back(word);
    return words;
}

std::uint64_t wholeNumber(const TextLines& lines, std::string_view text, std::string_view name) {
    const std::string_view word = takeWord(text);
    std::uint64_t number = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
    if (result.ec != std::errc{} || result.ptr != word.data() + word.size() || !takeWord(text).empty())
        lines.fail(fmt::format("{} is \"{}\", must be a whole number", name, shown(word)));
    return number;
}

double realNumber(const TextLines& lines, std::string_view word, std::string_view name) {
    double number = 0.0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
    if (result.ec != std::errc{} || result.ptr != word.data() + word.size())
        lines.fail(fmt::format("{} is \"{}\", must be a number", name, shown(word)));
    return number;
}

void skipLines(TextLines& lines, std::uint64_t count) {
    for (std::uint64_t row = 0; row < count; ++row) lines.next("its last particle");
}

void readTextRows(TextLines& lines, std::uint64_t count, std::span<const TextColumn> columns, ParticleTable& table) {
    std::map<std::string_view, std::uint32_t> species;
    table.firstLine = lines.lineNumber() + 1;
    for (std::uint64_t row = 0; row < count; ++row) {
        std::string_view line = lines.next("its last particle");
        for (const TextColumn& column : columns) {
            const std::string_view word = takeWord(line);
            if (word.empty())
                lines.fail(fmt::format("{} is missing: the line must have {} words", column.name, columns.size()));
            if (column.values != nullptr) column.values->push_back(realNumber(lines, word, column.name));
            if (!column.isSpecies) continue;
            const auto [place, isNew] = species.emplace(word, static_cast<std::uint32_t>(species.size()));
            if (isNew) table.speciesNames.emplace_back(word);
            table.species.push_back(place->second);
        }
        if (!takeWord(line).empty()) lines.fail(fmt::format("the line must have {} words, not more", columns.size()));
    }
    table.count = count;
}

void putNumber(std::string& text, double number) {
    putShortest(text, number);
}

void putNumber(std::string& text, std::uint32_t number) {
    putShortest(text, number);
}

std::string asWord(const std::string& name) {
    std::string word = name.empty() ? "_" : name;
    for (char& letter : word)
        if (static_cast<unsigned char>(letter) <= ' ' || letter == '"' || letter == '\'' || letter == '\\' ||
            letter == ',')
            letter = '_';
    return word;
}

}  // namespace scenes
