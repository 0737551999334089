// Single quotes keep everything but themselves.
#include "tools/system/shell_words.h"

#include <cctype>

namespace tools {
namespace {

std::string quoted(const std::string& word) {
    bool plain = !word.empty();
    for (const char c : word)
        plain = plain && (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                          std::string("-_./=,:+@%").find(c) != std::string::npos);
    if (plain) return word;
    std::string text(1, '\'');
    for (const char c : word) {
        if (c == '\'') text.append("'\\'");
        text.push_back(c);
    }
    text.push_back('\'');
    return text;
}

}  // namespace

std::string shellLine(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line.push_back(' ');
        line.append(quoted(word));
    }
    return line;
}

}  // namespace tools
