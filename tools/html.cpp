// Character by character, three bytes to four digits, tables row by row.
#include "tools/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace tools {
namespace {

std::string line(const char* tag, const Cells& cells) {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    return html + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        if (c == '&')
            html += "&amp;";
        else if (c == '<')
            html += "&lt;";
        else if (c == '>')
            html += "&gt;";
        else if (c == '"')
            html += "&quot;";
        else
            html += c;
    }
    return html;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const std::size_t present = std::min<std::size_t>(3, bytes.size() - k);
        std::uint32_t group = 0;
        for (std::size_t b = 0; b < 3; ++b) group = (group << 8) | (b < present ? bytes[k + b] : 0U);
        for (std::size_t digit = 0; digit < 4; ++digit)
            text += digit <= present ? kDigits[(group >> (18 - 6 * digit)) & 63U] : '=';
    }
    return text;
}

std::string table(const Cells& head, const std::vector<Cells>& rows) {
    std::string html = "<table>\n" + line("th", head);
    for (const Cells& row : rows) html += line("td", row);
    return html + "</table>\n";
}

std::string picture(const std::string& alt, const std::string& svg) {
    return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">\n", alt,
                       base64({svg.begin(), svg.end()}));
}

}  // namespace tools
