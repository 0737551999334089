// Splits the text of a scene file into statements (table headers and keys) and their lines, without parsing values.
// This lets the reader leave out one statement with a syntax error and go on to find the next problem. Called by
// schema/document.cpp only.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/text/value.h"

namespace scenes {

enum class StatementKind {
    tableHeader,  ///< [physics] or [[body]]
    keyValue,     ///< key = value
    unknown       ///< not recognizable as either
};

struct Statement {
    StatementKind kind = StatementKind::unknown;
    std::string name;                ///< name of the key or the table, as far as it can be read
    bool hasDoubleBrackets = false;  ///< the header opens with [[
    bool isClosed = true;            ///< every bracket and quotation mark in the value is closed
    std::size_t firstLine = 0;       ///< index of the statement's first line
    std::size_t lastLine = 0;
    SourcePosition position;  ///< position of the statement's first character
};

/// The lines of a text, without their line feeds.
std::vector<std::string> splitLines(std::string_view text);

/// The statements in the order in which they are written. Blank lines and comments belong to no statement.
std::vector<Statement> splitStatements(const std::vector<std::string>& lines);

}  // namespace scenes
