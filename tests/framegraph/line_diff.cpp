#include "tests/framegraph/line_diff.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fg::test {
namespace {

constexpr std::size_t kContext = 2;

struct Line {
  char mark;  ///< ' ', '-' or '+'.
  std::string_view text;
};

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// A shortest sequence of kept, removed and added lines, found through the longest common subsequence.
std::vector<Line> script(const std::vector<std::string_view>& before, const std::vector<std::string_view>& after) {
  const std::size_t width = after.size() + 1;
  std::vector<std::uint32_t> common((before.size() + 1) *
                                    width);  // Lengths of the longest common subsequences after two positions.
  for (std::size_t i = before.size(); i-- > 0;) {
    for (std::size_t j = after.size(); j-- > 0;) {
      common[i * width + j] = before[i] == after[j] ? common[(i + 1) * width + j + 1] + 1
                                                    : std::max(common[(i + 1) * width + j], common[i * width + j + 1]);
    }
  }
  std::vector<Line> lines;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < before.size() || j < after.size()) {
    if (i < before.size() && j < after.size() && before[i] == after[j]) {
      lines.push_back({' ', before[i]});
      ++i;
      ++j;
    } else if (j == after.size() || (i < before.size() && common[(i + 1) * width + j] >= common[i * width + j + 1])) {
      lines.push_back({'-', before[i++]});
    } else {
      lines.push_back({'+', after[j++]});
    }
  }
  return lines;
}

}  // namespace

std::string lineDiff(std::string_view before, std::string_view after) {
  if (before == after) return {};
  const std::vector<Line> lines = script(split(before), split(after));
  std::vector<bool> shown(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].mark == ' ') continue;
    const std::size_t end = std::min(i + kContext + 1, lines.size());
    for (std::size_t near = i - std::min(i, kContext); near < end; ++near) shown[near] = true;
  }
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (shown[i]) {
      text += std::string{lines[i].mark, ' '}.append(lines[i].text) + "\n";
    } else if (i == 0 || shown[i - 1]) {
      text += "...\n";
    }
  }
  return text.empty() ? "only the end of the last line differs\n" : text;
}

}  // namespace fg::test
