// A scanner that knows the strings, brackets and comments of TOML and nothing else of the language.
#include "scenes/text/toml_statements.h"

#include <cctype>

namespace scenes {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool isBareKeyCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

std::size_t skipBlanks(const std::string& line, std::size_t at) {
    const std::size_t found = line.find_first_not_of(kBlanks, at);
    return found == std::string::npos ? line.size() : found;
}

/// The name that starts at an index of a line, such as physics or physics.step; empty if none does.
std::string nameAt(const std::string& line, std::size_t start) {
    std::size_t end = start;
    while (end < line.size() && (isBareKeyCharacter(line[end]) || line[end] == '.')) ++end;
    return line.substr(start, end - start);
}

/// Whether a name starts at an index of a line and is followed, after any blanks, by the given text.
bool isNameBefore(const std::string& line, std::size_t start, std::string_view after) {
    const std::string name = nameAt(line, start);
    if (name.empty()) return false;
    const std::size_t next = skipBlanks(line, start + name.size());
    return line.compare(next, after.size(), after) == 0;
}

/// Whether a line starts a new statement and cannot continue a list: a complete header, or a key and its equals sign.
bool opensStatement(const std::string& line) {
    const std::size_t first = skipBlanks(line, 0);
    if (isNameBefore(line, first, "=")) return true;
    if (line.compare(first, 2, "[[") == 0) return isNameBefore(line, skipBlanks(line, first + 2), "]]");
    // A line like [1] or [a], is an element of a list: the name in a header starts with a letter, and no comma follows
    // the header.
    return line.compare(first, 1, "[") == 0 && isNameBefore(line, skipBlanks(line, first + 1), "]") &&
           !isNameBefore(line, skipBlanks(line, first + 1), "],") &&
           std::isalpha(static_cast<unsigned char>(line[skipBlanks(line, first + 1)])) != 0;
}

/// The brackets and strings that are still open at the end of a line of TOML.
struct OpenDelimiters {
    int brackets = 0;
    std::string quote;               ///< delimiter of a string that spans lines; empty if none is open
    bool hasUnclosedString = false;  ///< a string of one line did not end in its line
};

/// Index behind the closing delimiter of a string; npos if the string does not end in this line.
/// @param from  index behind the opening delimiter
std::size_t endOfString(const std::string& line, std::size_t from, const std::string& delimiter) {
    for (std::size_t at = from; at < line.size(); ++at) {
        if (line[at] == '\\' && delimiter[0] == '"')
            ++at;
        else if (line.compare(at, delimiter.size(), delimiter) == 0)
            return at + delimiter.size();
    }
    return std::string::npos;
}

/// Updates the open brackets and strings with the characters of a line from an index on.
void scanLine(const std::string& line, std::size_t at, OpenDelimiters& open) {
    while (at < line.size()) {
        if (!open.quote.empty()) {
            at = endOfString(line, at, open.quote);
            if (at == std::string::npos) return;
            open.quote.clear();
            continue;
        }
        const char c = line[at];
        if (c == '#') return;
        if (c == '"' || c == '\'') {
            const std::string triple(3, c);
            const bool isTriple = line.compare(at, 3, triple) == 0;
            open.quote = isTriple ? triple : std::string(1, c);
            at = endOfString(line, at + open.quote.size(), open.quote);
            // A string that opens with one quotation mark, not three, ends with its line, closed or not.
            if (at != std::string::npos || !isTriple) open.quote.clear();
            open.hasUnclosedString = open.hasUnclosedString || (at == std::string::npos && !isTriple);
            if (at == std::string::npos) return;
            continue;
        }
        if (c == '[' || c == '{') ++open.brackets;
        if (c == ']' || c == '}') --open.brackets;
        ++at;
    }
}

Statement headerAt(const std::string& line, std::size_t first) {
    Statement statement;
    statement.kind = StatementKind::tableHeader;
    statement.hasDoubleBrackets = line.compare(first, 2, "[[") == 0;
    statement.name = nameAt(line, skipBlanks(line, first + (statement.hasDoubleBrackets ? 2 : 1)));
    return statement;
}

/// The statement key = value that starts in a line. A value whose bracket or string is never closed is taken to end
/// with its first line.
Statement keyValueAt(const std::vector<std::string>& lines, std::size_t index, std::size_t first) {
    Statement statement;
    statement.name = nameAt(lines[index], first);
    if (!statement.name.empty()) statement.kind = StatementKind::keyValue;
    OpenDelimiters open;
    scanLine(lines[index], first, open);
    std::size_t last = index;
    while ((open.brackets > 0 || !open.quote.empty()) && last + 1 < lines.size()) {
        if (open.quote.empty() && opensStatement(lines[last + 1])) break;
        scanLine(lines[++last], 0, open);
    }
    statement.isClosed = open.brackets <= 0 && open.quote.empty() && !open.hasUnclosedString;
    statement.lastLine = open.quote.empty() ? last : index;
    return statement;
}

}  // namespace

std::vector<std::string> splitLines(std::string_view text) {
    std::vector<std::string> lines;
    while (true) {
        const std::size_t end = text.find('\n');
        lines.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return lines;
        text.remove_prefix(end + 1);
    }
}

std::vector<Statement> splitStatements(const std::vector<std::string>& lines) {
    std::vector<Statement> statements;
    for (std::size_t index = 0; index < lines.size(); ++index) {
        const std::size_t first = skipBlanks(lines[index], 0);
        if (first == lines[index].size() || lines[index][first] == '#') continue;
        const bool isHeader = lines[index][first] == '[';
        Statement statement = isHeader ? headerAt(lines[index], first) : keyValueAt(lines, index, first);
        statement.firstLine = index;
        if (isHeader) statement.lastLine = index;
        statement.position = {.line = static_cast<int>(index) + 1, .column = static_cast<int>(first) + 1};
        index = statement.lastLine;
        statements.push_back(std::move(statement));
    }
    return statements;
}

}  // namespace scenes
