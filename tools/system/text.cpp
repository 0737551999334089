// Shell quoting, where single quotes protect every character except the single quote itself, and the widths of texts.
#include "tools/system/text.h"

#include <fmt/format.h>
#include <locale.h>

#include <algorithm>
#include <cctype>
#include <cwchar>

namespace tools {
namespace {

std::string quoted(const std::string& word) {
    bool isPlain = !word.empty();
    for (const char c : word)
        isPlain = isPlain && (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                              std::string("-_./=,:+@%").find(c) != std::string::npos);
    if (isPlain) return word;
    std::string text(1, '\'');
    for (const char c : word) {
        if (c == '\'') text.append("'\\'");
        text.push_back(c);
    }
    text.push_back('\'');
    return text;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        const auto next = static_cast<unsigned char>(k + 1 < text.size() ? text[k + 1] : 0);
        const bool isControl = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F;
        if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {  // U+0080 to U+009F in UTF-8, among them another escape
            result += fmt::format("\\u{:04x}", next);
            ++k;
        } else if (isControl) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += text[k];
        }
    }
    return result;
}

std::string shellLine(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line.push_back(' ');
        line.append(quoted(word));
    }
    return line;
}

FittedText fitColumns(std::string_view text, int most) {
    // The C library knows characters and their widths by the locale, and the program runs in the locale "C".
    static const locale_t utf8 = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    const locale_t previous = ::uselocale(utf8);
    FittedText fitted;
    std::size_t length = 0;
    for (; !text.empty(); text.remove_prefix(length)) {
        std::mbstate_t state = {};
        wchar_t character = 0;
        length = std::mbrtowc(&character, text.data(), text.size(), &state);
        const bool isCharacter = length > 0 && length <= text.size();  // errors are the largest numbers
        if (!isCharacter) length = 1;
        const int width = isCharacter ? ::wcwidth(character) : -1;
        const bool isPrintable = width >= 0;
        const int columns = isPrintable ? width : 1;
        if (fitted.columns + columns > most) break;
        fitted.columns += columns;
        fitted.text += isPrintable ? text.substr(0, length) : std::string_view("?");
    }
    ::uselocale(previous);
    return fitted;
}

Table parseCsv(const std::string& csv, std::size_t skippedColumns) {
    std::vector<Cells> lines(1, Cells(1));
    bool isQuoted = false;
    for (std::size_t k = 0; k < csv.size(); ++k) {
        const char c = csv[k];
        if (c == '"' && isQuoted && csv[k + 1] == '"')
            lines.back().back() += csv[k++];
        else if (c == '"')
            isQuoted = !isQuoted;
        else if (c == ',' && !isQuoted)
            lines.back().emplace_back();
        else if (c == '\n' && !isQuoted)
            lines.emplace_back(1);
        else
            lines.back().back() += c;
    }
    lines.pop_back();  // the text after the last line end is no line
    for (Cells& line : lines) line.erase(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(skippedColumns));
    Table table{lines.front(), {lines.begin() + 1, lines.end()}};
    for (std::string& text : table.head) std::replace(text.begin(), text.end(), '_', ' ');
    return table;
}

std::string textTable(const Table& table) {
    std::vector<Cells> lines = {table.head};
    lines.insert(lines.end(), table.rows.begin(), table.rows.end());
    std::vector<std::size_t> widths(table.head.size());
    for (const Cells& line : lines)
        for (std::size_t column = 0; column < line.size(); ++column)
            widths[column] = std::max(widths[column], line[column].size());
    std::string text;
    for (const Cells& line : lines) {
        text += fmt::format("{:{}}", line[0], widths[0]);
        for (std::size_t column = 1; column < line.size(); ++column)
            text += fmt::format("  {:>{}}", line[column], widths[column]);
        text += '\n';
    }
    return text;
}

}  // namespace tools
