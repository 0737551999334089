// Parses TOML with toml++, which stops at the first syntax error. To report every error of a file at once, an error is
// recorded, the statement that it is in is repaired or left out, and the text is parsed again. Lines keep their
// numbers, so that later problems are reported at their positions.
#include "scenes/schema/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "scenes/schema/schema.h"
#include "scenes/text/toml_statements.h"

namespace scenes {
namespace {

/// How often a text is parsed at most. Chosen: bounds the time spent on a file that is not a scene at all. A statement
/// is repaired at most twice.
constexpr int kMaxParses = 200;

/// Largest number of parts of a dotted key, and depth of nested tables: as deep as toml++ allows nested values.
constexpr int kMaxDepth = 256;

/// The string that replaces a value which could not be parsed. No scene contains its control character.
constexpr std::string_view kInvalidMarker = "\x7Finvalid";

SourcePosition positionOf(const toml::source_region& region) {
    return {.line = static_cast<int>(region.begin.line), .column = static_cast<int>(region.begin.column)};
}

Value valueOf(const toml::node& node, int depth);

/// The entries of a TOML table in the order in which they are written; none below kMaxDepth. No key of a scene is
/// nested that deep, so that the key at the top of such nesting is reported as unknown.
std::vector<Entry> entriesOf(const toml::table& table, int depth = 0) {
    std::vector<Entry> entries;
    if (depth > kMaxDepth) return entries;
    for (auto&& [key, node] : table)
        entries.push_back({std::string(key.str()), positionOf(key.source()), valueOf(node, depth + 1)});
    std::ranges::stable_sort(entries, {}, &Entry::position);
    return entries;
}

Value valueOf(const toml::node& node, int depth = 0) {
    Value value;
    value.position = positionOf(node.source());
    if (const auto* table = node.as_table()) {
        value.kind = ValueKind::table;
        value.entries = entriesOf(*table, depth);
    } else if (const auto* array = node.as_array()) {
        value.kind = ValueKind::array;
        for (const toml::node& item : *array) value.items.push_back(valueOf(item, depth + 1));
    } else if (const auto* text = node.as_string()) {
        value.string = text->get();
        value.kind = value.string == kInvalidMarker ? ValueKind::invalid : ValueKind::string;
    } else if (const auto* integer = node.as_integer()) {
        value.kind = ValueKind::integer;
        value.integer = integer->get();
        value.number = static_cast<double>(value.integer);
    } else if (const auto* real = node.as_floating_point()) {
        value.kind = ValueKind::floatingPoint;
        value.number = real->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.kind = ValueKind::boolean;
        value.boolean = boolean->get();
    } else {
        value.kind = ValueKind::dateTime;
    }
    return value;
}

/// The text of a scene file while syntax errors in it are repaired, line by line.
struct RepairableText {
    std::vector<std::string> lines;
    std::vector<Statement> statements;
    std::vector<int> repairCounts;  ///< for each statement (a key or header), how often its syntax was repaired
    bool hasOmissions = false;

    explicit RepairableText(std::string_view text)
        : lines(splitLines(text)), statements(splitStatements(lines)), repairCounts(statements.size(), 0) {}

    std::string text() const { return fmt::format("{}\n", fmt::join(lines, "\n")); }
};

void blank(RepairableText& source, std::size_t firstLine, std::size_t lastLine) {
    for (std::size_t line = firstLine; line <= lastLine; ++line) source.lines[line].clear();
}

/// Index of the statement that caused a parse error in a line. The parser notices a value that is never closed only in
/// the statement after it.
/// @param line  counted from 1
std::size_t statementAt(const RepairableText& source, std::size_t line) {
    std::size_t index = 0;
    while (index + 1 < source.statements.size() && source.statements[index + 1].firstLine + 1 <= line) ++index;
    const bool runsOn = index > 0 && !source.statements[index - 1].isClosed && source.repairCounts[index - 1] == 0;
    return runsOn ? index - 1 : index;
}

/// Index of the last line of the table that a header opens, with the tables within it.
std::size_t sectionEnd(const RepairableText& source, std::size_t header) {
    const std::string inside = source.statements[header].name + '.';
    for (std::size_t next = header + 1; next < source.statements.size(); ++next) {
        const Statement& statement = source.statements[next];
        if (statement.kind == StatementKind::tableHeader && !statement.name.starts_with(inside))
            return statement.firstLine - 1;
    }
    return source.lines.size() - 1;
}

/// Index of the earlier statement that a duplicate key or table repeats; index of the duplicate itself if none is
/// found.
std::size_t firstDefinition(const RepairableText& source, std::size_t index) {
    const Statement& statement = source.statements[index];
    for (std::size_t earlier = index; earlier-- > 0;) {
        const Statement& candidate = source.statements[earlier];
        if (statement.kind == StatementKind::keyValue && candidate.kind == StatementKind::tableHeader) break;
        if (candidate.kind == statement.kind && candidate.name == statement.name) return earlier;
    }
    return index;
}

std::string duplicateMessage(const RepairableText& source, std::size_t index) {
    const Statement& statement = source.statements[index];
    const std::size_t first = firstDefinition(source, index);
    std::string message = fmt::format("{} \"{}\" is given twice",
                                      statement.kind == StatementKind::tableHeader ? "table" : "key", statement.name);
    if (first != index) message += fmt::format(", first in line {}", source.statements[first].firstLine + 1);
    const TableInfo* table = findTable(statement.name);
    if (statement.kind == StatementKind::tableHeader && table != nullptr && table->allowsList)
        message += fmt::format(" (several of them are written [[{}]])", statement.name);
    return message;
}

/// The message for a parse error of toml++, whose descriptions open with a preamble that is left out.
std::string parserMessage(std::string_view description) {
    for (const std::string_view preamble : {"Error while parsing ", "Encountered "})
        if (description.substr(0, preamble.size()) == preamble) description.remove_prefix(preamble.size());
    return "syntax error: " + std::string(description);
}

/// Whether a statement repeats an earlier key or table. A key that is repeated within an inline table does not count.
bool isDuplicate(const RepairableText& source, std::size_t index, const toml::parse_error& error) {
    if (error.description().find("cannot redefine") == std::string_view::npos) return false;
    return source.statements[index].kind == StatementKind::tableHeader || firstDefinition(source, index) != index;
}

void report(const RepairableText& source, std::size_t index, const toml::parse_error& error, ProblemList& problems) {
    const Statement& statement = source.statements[index];
    if (isDuplicate(source, index, error))
        problems.add(statement.position, duplicateMessage(source, index));
    else if (!statement.isClosed)
        problems.add(statement.position, fmt::format("the value of \"{}\" is never closed", statement.name));
    else
        problems.add(positionOf(error.source()), parserMessage(error.description()));
}

/// Rewrites the header of a table as [name] or [[name]], as the schema asks for it. The header of a duplicate, or one
/// whose name cannot be read, is left out with all keys below it, so that these are not mistaken for keys of the table
/// before.
void repairHeader(RepairableText& source, std::size_t index, bool isRepeated) {
    const Statement& statement = source.statements[index];
    const TableInfo* table = findTable(statement.name);
    if (table == nullptr || isRepeated || source.repairCounts[index] > 1) {
        blank(source, statement.firstLine, sectionEnd(source, index));
        source.hasOmissions = source.hasOmissions || !isRepeated;
        return;
    }
    const bool isList = table->allowsList && (statement.hasDoubleBrackets || !table->allowsSingle);
    source.lines[statement.firstLine] =
        isList ? fmt::format("[[{}]]", statement.name) : fmt::format("[{}]", statement.name);
}

/// Repairs a statement with a syntax error: replaces a value that cannot be parsed by a marker. A duplicate, or a
/// statement in error for the second time, is left out.
void repair(RepairableText& source, std::size_t index, bool isRepeated) {
    const Statement& statement = source.statements[index];
    const bool wasRepaired = source.repairCounts[index]++ > 0;
    if (statement.kind == StatementKind::tableHeader) return repairHeader(source, index, isRepeated);
    blank(source, statement.firstLine, statement.lastLine);
    if (statement.kind == StatementKind::keyValue && !isRepeated && !wasRepaired)
        source.lines[statement.firstLine] = fmt::format("{} = \"\\u007F{}\"", statement.name, kInvalidMarker.substr(1));
    else if (!isRepeated)
        source.hasOmissions = true;
}

/// Leaves out dotted keys with so many parts that toml++, which does not limit their number, would overflow the stack.
void removeDeepKeys(RepairableText& source, ProblemList& problems) {
    for (const Statement& statement : source.statements) {
        if (std::ranges::count(statement.name, '.') < kMaxDepth) continue;
        problems.add(statement.position, fmt::format("the key has more than {} parts", kMaxDepth));
        blank(source, statement.firstLine, statement.lastLine);
        source.hasOmissions = true;
    }
}

}  // namespace

Document parseDocument(std::string_view text, ProblemList& problems) {
    RepairableText source(text);
    removeDeepKeys(source, problems);
    for (int parse = 0; parse < kMaxParses; ++parse) {
        try {
            const toml::table root = toml::parse(source.text());
            Document document;
            document.root.entries = entriesOf(root);
            document.hasOmissions = source.hasOmissions;
            return document;
        } catch (const toml::parse_error& error) {
            if (source.statements.empty()) {
                problems.add(positionOf(error.source()), parserMessage(error.description()));
                break;
            }
            const std::size_t index = statementAt(source, error.source().begin.line);
            if (source.repairCounts[index] == 0) report(source, index, error, problems);
            if (source.repairCounts[index] > 1) break;
            repair(source, index, isDuplicate(source, index, error));
        }
    }
    problems.throwIfAny();
    return {};
}

Value parseOverrideValue(const std::string& text, int overrideIndex) {
    Value value;
    value.kind = ValueKind::string;
    value.string = text;
    try {
        const toml::table parsed = toml::parse("v = " + text);
        if (const toml::node* node = parsed.get("v"); node != nullptr && parsed.size() == 1) value = valueOf(*node);
    } catch (const toml::parse_error&) {
        // Text that is not a TOML value is an unquoted string.
    }
    const auto relocate = [&](const auto& self, Value& part) -> void {
        part.position = {.overrideIndex = overrideIndex};
        for (Value& item : part.items) self(self, item);
        for (Entry& entry : part.entries) {
            entry.position = part.position;
            self(self, entry.value);
        }
    };
    relocate(relocate, value);
    return value;
}

}  // namespace scenes
