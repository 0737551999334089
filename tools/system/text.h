// Text on the command line and on the terminal: numbers in flags and file names, commands to copy, and tables.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tools {

/// The text of a file that the build embeds in the program (tools/CMakeLists.txt), by its name without folder.
std::string_view embeddedText(std::string_view name);

/// The number that the whole text spells, in any locale; nothing if the text is anything else.
template <class Number = int>
std::optional<Number> parseNumber(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Text for a terminal: control characters other than line ends and tabs, which a name or a title may contain, are
/// written as in JSON, such as \u001b. JSON stays the same JSON.
std::string printable(std::string_view text);

/// The words as one line for a POSIX shell, each quoted if it needs to be.
std::string shellLine(const std::vector<std::string>& words);

/// The beginning of a text, as a terminal shows it.
struct FittedText {
    std::string text;
    int columns = 0;  ///< how many columns of the terminal it takes
};

/// As much of a text in UTF-8 as fits into `most` columns of a terminal, where characters may be none, one or two
/// columns wide. Control characters and bytes that are not UTF-8 become question marks.
FittedText fitColumns(std::string_view text, int most);

/// The texts of one row of a table.
using Cells = std::vector<std::string>;

/// A table for the terminal or for a page.
struct Table {
    Cells head;
    std::vector<Cells> rows;
};

/// The table in a CSV file's text (RFC 4180), whose first line is the head. Underscores in the head become spaces.
/// @param skippedColumns  how many columns on the left are left out
Table parseCsv(const std::string& csv, std::size_t skippedColumns);

/// The table in aligned columns, the first to the left and the others to the right.
std::string textTable(const Table& table);

}  // namespace tools
