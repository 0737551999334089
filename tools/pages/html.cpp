// HTML as strings: escaping, base64, tables, and the head and body that all pages share except that of `compare`.
#include "tools/pages/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace tools {
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

std::string dataUri(const std::string& type, const std::vector<unsigned char>& bytes) {
    return "data:" + type + ";base64," + base64(bytes);
}

std::string htmlTable(const Table& table, const std::vector<bool>& isBad) {
    std::string html = "<table>\n";
    const auto addRow = [&](const Cells& cells, const char* attributes, const char* tag) {
        html += fmt::format("<tr{}>", attributes);
        for (const std::string& text : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
        html += "</tr>\n";
    };
    addRow(table.head, "", "th");
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        addRow(table.rows[row], row < isBad.size() && isBad[row] ? " class=\"bad\"" : "", "td");
    return html + "</table>\n";
}

std::string svgImage(const std::string& alt, const std::string& svg) {
    return fmt::format("<img alt=\"{}\" src=\"{}\">\n", alt, dataUri("image/svg+xml", {svg.begin(), svg.end()}));
}

std::string htmlPage(const std::string& title, const std::string& body) {
    return fmt::format(R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{0}</title>
<style>
{1}</style></head><body>
<h1>{0}</h1>
{2}</body></html>
)",
                       title, embeddedText("page.css"), body);
}

}  // namespace tools
