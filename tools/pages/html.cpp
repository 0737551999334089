// Character by character, three bytes to four digits, tables row by row.
#include "tools/pages/html.h"

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

std::string dataUri(const std::string& type, const std::vector<unsigned char>& bytes) {
    return "data:" + type + ";base64," + base64(bytes);
}

std::string studyHead(const std::string& title, const std::string& style) {
    return fmt::format(R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{0}</title>
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; padding: 2rem 1rem; color: #222; background: #f6f6f4; }}
img {{ max-width: 100%; background: #fff; border: 1px solid #ddd; }}
table {{ border-collapse: collapse; font-size: 0.85rem; background: #fff; font-variant-numeric: tabular-nums; }}
th, td {{ border: 1px solid #ddd; vertical-align: top; }}
th {{ background: #eee; }}
code {{ background: #f0f0ec; padding: 0 0.2rem; }}
{1}</style></head><body>
<h1>{0}</h1>
)",
                       title, style);
}

std::string picture(const std::string& alt, const std::string& svg) {
    return fmt::format("<img alt=\"{}\" src=\"{}\">\n", alt, dataUri("image/svg+xml", {svg.begin(), svg.end()}));
}

}  // namespace tools
