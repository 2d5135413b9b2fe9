#include "samples/command_line/arguments.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "samples/command_line/usage_error.h"

namespace walr {
namespace {

std::optional<int> parseNumber(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= 0 ? std::optional(value) : std::nullopt;
}

/// Two numbers with a separator between them. A single number counts as both.
std::optional<std::pair<int, int>> parsePair(std::string_view text, char separator) {
  const std::size_t split = text.find(separator);
  const std::optional<int> first = parseNumber(text.substr(0, split));
  const std::optional<int> second = split == std::string_view::npos ? first : parseNumber(text.substr(split + 1));
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace

FrameRange parseFrameRange(const std::string& text, const std::string& option) {
  const auto pair = parsePair(text, '-');
  if (!pair || pair->first > pair->second) {
    throw UsageError(option + " " + text + ": give a first and a last frame number, as in " + option + " 0-31");
  }
  if (pair->second > FrameRange::kMost) {
    throw UsageError(option + " " + text + ": frames have numbers of up to nine digits, 0 to " +
                     std::to_string(FrameRange::kMost));
  }
  return {pair->first, pair->second};
}

CLI::Validator numberFrom(double least, double most) {
  std::ostringstream range;
  range << "in [" << least << " - " << most << "]";
  return {[=, text = range.str()](std::string& given) {
            double value = 0.0;
            const char* const end = given.data() + given.size();
            const auto [rest, error] = std::from_chars(given.data(), end, value);
            const bool isNumber = error == std::errc() && rest == end;
            return isNumber && value >= least && value <= most ? std::string() : given + " is not a number " + text;
          },
          "FLOAT:FLOAT " + range.str()};
}

fg::Extent parseSize(const std::string& text, const std::string& option) {
  constexpr int kLargest = 16384;
  const auto pair = text.find('x') == std::string::npos ? std::nullopt : parsePair(text, 'x');
  if (!pair || pair->first < 1 || pair->second < 1 || pair->first > kLargest || pair->second > kLargest) {
    throw UsageError(option + " " + text + ": give width x height in pixels, 1 to 16384 each, as in " + option +
                     " 1920x1080");
  }
  return {static_cast<std::uint32_t>(pair->first), static_cast<std::uint32_t>(pair->second)};
}

std::optional<float> parseExposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  float stops = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stops);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(stops)) {
    throw UsageError("--exposure " + text + ": give auto or a number of stops, as in --exposure 1.5");
  }
  return stops;
}

}  // namespace walr
