// Character by character, and three bytes to four digits.
#include "tools/html.h"

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

}  // namespace tools
