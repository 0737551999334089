// Reads a frame rate from text.
#include "scenes/text/frame_rate.h"

#include <charconv>
#include <numeric>
#include <system_error>

namespace scenes {
namespace {

/// The whole number from 1 to a million that the text spells; 0 for any other text. Up to this bound, the product of a
/// frame number and a denominator is exact.
int termOf(std::string_view text) {
    constexpr int kMost = 1'000'000;
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isNumber = error == std::errc() && end == text.data() + text.size();
    return isNumber && number >= 1 && number <= kMost ? number : 0;
}

}  // namespace

std::optional<render::FrameRate> frameRateFrom(std::string_view text) {
    const std::size_t slash = text.find('/');
    const int numerator = termOf(text.substr(0, slash));
    const int denominator = slash == std::string_view::npos ? 1 : termOf(text.substr(slash + 1));
    if (numerator == 0 || denominator == 0) return std::nullopt;
    const int divisor = std::gcd(numerator, denominator);
    return render::FrameRate{numerator / divisor, denominator / divisor};
}

}  // namespace scenes
