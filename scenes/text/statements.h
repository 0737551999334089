// The statements of a scene file, found without parsing their values: which lines a header or a key spans. It lets the
// reader leave out one broken statement and go on to find the next mistake. Called by document.cpp only.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

enum class Form {
    header,  ///< [physics] or [[body]]
    pair,    ///< key = value
    other    ///< neither can be recognized
};

struct Statement {
    Form form = Form::other;
    std::string name;            ///< the key or the table, as far as it can be read
    bool doubleBracket = false;  ///< the header opens with [[
    bool closed = true;          ///< every bracket and quote of the value is closed
    std::size_t firstLine = 0;   ///< index into the lines
    std::size_t lastLine = 0;
    int column = 1;  ///< of its first character, from 1
};

/// The lines of a text without their line feeds.
std::vector<std::string> splitLines(std::string_view text);

/// The statements in order; blank lines and comments belong to none.
std::vector<Statement> splitStatements(const std::vector<std::string>& lines);

}  // namespace scenes
