// toml++ stops at the first syntax error. So: record it, mend or leave out the statement it is in, and parse again.
// Lines keep their numbers, so later problems are reported where they stand.
#include "scenes/schema/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <utility>

#include "scenes/schema/schema.h"
#include "scenes/text/statements.h"

namespace scenes {
namespace {

/// Bounds the time spent on a file that is no scene at all; a statement is mended at most twice.
constexpr int kMostParses = 200;

/// Parts of a key, and tables within tables: as many as the parser takes of values within values.
constexpr int kDeepest = 256;

/// Stands in for a value that could not be read.
constexpr std::string_view kBroken =
    "\x7F"
    "broken";

Position positionOf(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

bool isBefore(const Position& a, const Position& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
}

Value valueOf(const toml::node& node, int depth);

/// None beyond the deepest: no key of a scene is there, so that its beginning is reported as unknown.
std::vector<Entry> entriesOf(const toml::table& table, int depth = 0) {
    std::vector<Entry> entries;
    if (depth > kDeepest) return entries;
    for (auto&& [key, node] : table)
        entries.push_back({std::string(key.str()), positionOf(key.source()), valueOf(node, depth + 1)});
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return isBefore(a.at, b.at); });
    return entries;
}

Value valueOf(const toml::node& node, int depth = 0) {
    Value value;
    value.at = positionOf(node.source());
    if (const auto* table = node.as_table()) {
        value.kind = Kind::table;
        value.entries = entriesOf(*table, depth);
    } else if (const auto* array = node.as_array()) {
        value.kind = Kind::array;
        for (const toml::node& item : *array) value.items.push_back(valueOf(item, depth + 1));
    } else if (const auto* text = node.as_string()) {
        value.text = text->get();
        value.kind = value.text == kBroken ? Kind::broken : Kind::text;
    } else if (const auto* integer = node.as_integer()) {
        value.kind = Kind::integer;
        value.integer = integer->get();
        value.real = static_cast<double>(value.integer);
    } else if (const auto* real = node.as_floating_point()) {
        value.kind = Kind::real;
        value.real = real->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.kind = Kind::boolean;
        value.boolean = boolean->get();
    } else {
        value.kind = Kind::date;
    }
    return value;
}

/// A text under repair.
struct Repair {
    std::vector<std::string> lines;
    std::vector<Statement> statements;
    std::vector<int> attempts;  ///< at each statement
    bool damaged = false;

    explicit Repair(std::string_view text)
        : lines(splitLines(text)), statements(splitStatements(lines)), attempts(statements.size(), 0) {}

    std::string text() const {
        std::string joined;
        for (const std::string& line : lines) joined += line + '\n';
        return joined;
    }
};

void blank(Repair& repair, std::size_t firstLine, std::size_t lastLine) {
    for (std::size_t line = firstLine; line <= lastLine; ++line) repair.lines[line].clear();
}

/// The statement an error on a line (from 1) is in. An unclosed value runs into its successor, where the parser notices
/// it.
std::size_t culprit(const Repair& repair, std::size_t line) {
    std::size_t index = 0;
    while (index + 1 < repair.statements.size() && repair.statements[index + 1].firstLine + 1 <= line) ++index;
    const bool runsOn = index > 0 && !repair.statements[index - 1].closed && repair.attempts[index - 1] == 0;
    return runsOn ? index - 1 : index;
}

/// The last line of the section that a header opens.
std::size_t sectionEnd(const Repair& repair, std::size_t header) {
    for (std::size_t next = header + 1; next < repair.statements.size(); ++next)
        if (repair.statements[next].form == Form::header) return repair.statements[next].firstLine - 1;
    return repair.lines.size() - 1;
}

/// Index of the statement that a duplicate repeats; its own index if it cannot be told.
std::size_t original(const Repair& repair, std::size_t index) {
    const Statement& statement = repair.statements[index];
    for (std::size_t earlier = index; earlier-- > 0;) {
        const Statement& candidate = repair.statements[earlier];
        if (statement.form == Form::pair && candidate.form == Form::header) break;
        if (candidate.form == statement.form && candidate.name == statement.name) return earlier;
    }
    return index;
}

std::string duplicateMessage(const Repair& repair, std::size_t index) {
    const Statement& statement = repair.statements[index];
    const std::size_t first = original(repair, index);
    std::string message =
        fmt::format("{} \"{}\" is given twice", statement.form == Form::header ? "table" : "key", statement.name);
    if (first != index) message += fmt::format(", first in line {}", repair.statements[first].firstLine + 1);
    const TableInfo* table = findTable(statement.name);
    if (statement.form == Form::header && table != nullptr && table->list)
        message += fmt::format(" (several of them are written [[{}]])", statement.name);
    return message;
}

/// The parser's words without their preamble.
std::string plainWords(std::string_view description) {
    for (const std::string_view preamble : {"Error while parsing ", "Encountered "})
        if (description.substr(0, preamble.size()) == preamble) description.remove_prefix(preamble.size());
    return "syntax error: " + std::string(description);
}

/// Whether a statement repeats an earlier one; not whether there is a repetition within its value.
bool isDuplicate(const Repair& repair, std::size_t index, const toml::parse_error& error) {
    if (error.description().find("cannot redefine") == std::string_view::npos) return false;
    return repair.statements[index].form == Form::header || original(repair, index) != index;
}

void report(const Repair& repair, std::size_t index, const toml::parse_error& error, ProblemList& problems) {
    const Statement& statement = repair.statements[index];
    const Position start{static_cast<int>(statement.firstLine) + 1, statement.column};
    if (isDuplicate(repair, index, error))
        problems.add(start, duplicateMessage(repair, index));
    else if (!statement.closed)
        problems.add(start, fmt::format("the value of \"{}\" is never closed", statement.name));
    else
        problems.add(positionOf(error.source()), plainWords(error.description()));
}

/// A header in the form that its table has; a repeated or nameless one is left out with its whole section, so that its
/// keys are not mistaken for those of the section before.
void mendHeader(Repair& repair, std::size_t index, bool duplicate) {
    const Statement& statement = repair.statements[index];
    const TableInfo* table = findTable(statement.name);
    if (table == nullptr || duplicate || repair.attempts[index] > 1) {
        blank(repair, statement.firstLine, sectionEnd(repair, index));
        repair.damaged = repair.damaged || !duplicate;
        return;
    }
    const bool doubled = table->list && (statement.doubleBracket || !table->single);
    repair.lines[statement.firstLine] =
        doubled ? fmt::format("[[{}]]", statement.name) : fmt::format("[{}]", statement.name);
}

void mend(Repair& repair, std::size_t index, bool duplicate) {
    const Statement& statement = repair.statements[index];
    const bool again = repair.attempts[index]++ > 0;
    if (statement.form == Form::header) return mendHeader(repair, index, duplicate);
    blank(repair, statement.firstLine, statement.lastLine);
    if (statement.form == Form::pair && !duplicate && !again)
        repair.lines[statement.firstLine] = fmt::format("{} = \"\\u007F{}\"", statement.name, kBroken.substr(1));
    else if (!duplicate)
        repair.damaged = true;
}

/// The parser has no limit for the parts of a key, but the stack has one.
void leaveOutDeepKeys(Repair& repair, ProblemList& problems) {
    for (const Statement& statement : repair.statements) {
        if (std::ranges::count(statement.name, '.') < kDeepest) continue;
        problems.add({static_cast<int>(statement.firstLine) + 1, statement.column},
                     fmt::format("a key of more than {} parts", kDeepest));
        blank(repair, statement.firstLine, statement.lastLine);
        repair.damaged = true;
    }
}

}  // namespace

Document parseDocument(std::string_view text, ProblemList& problems) {
    Repair repair(text);
    leaveOutDeepKeys(repair, problems);
    for (int parse = 0; parse < kMostParses; ++parse) {
        try {
            const toml::table root = toml::parse(repair.text());
            Document document;
            document.root.entries = entriesOf(root);
            document.damaged = repair.damaged;
            return document;
        } catch (const toml::parse_error& error) {
            if (repair.statements.empty()) {
                problems.add(positionOf(error.source()), plainWords(error.description()));
                break;
            }
            const std::size_t index = culprit(repair, error.source().begin.line);
            if (repair.attempts[index] == 0) report(repair, index, error, problems);
            if (repair.attempts[index] > 1) break;
            mend(repair, index, isDuplicate(repair, index, error));
        }
    }
    problems.throwIfAny();
    return {};
}

Value parseOverrideValue(const std::string& text, int overrideIndex) {
    Value value;
    value.kind = Kind::text;
    value.text = text;
    try {
        const toml::table parsed = toml::parse("v = " + text);
        if (const toml::node* node = parsed.get("v"); node != nullptr && parsed.size() == 1) value = valueOf(*node);
    } catch (const toml::parse_error&) {
        // A bare word.
    }
    const auto relocate = [&](const auto& self, Value& part) -> void {
        part.at = {0, 0, overrideIndex};
        for (Value& item : part.items) self(self, item);
        for (Entry& entry : part.entries) {
            entry.at = part.at;
            self(self, entry.value);
        }
    };
    relocate(relocate, value);
    return value;
}

}  // namespace scenes
