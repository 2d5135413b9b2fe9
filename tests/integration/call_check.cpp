#include "tests/integration/call_check.h"

#include <algorithm>

namespace walr::test {
namespace {

/// No random call sets this size.
constexpr std::uint32_t kMarkSize = 1;
constexpr std::string_view kMark = "WalrDevice::struct_size is 1:";

}  // namespace

void CallCheck::leaveMark() {
  WalrDevice device{};
  device.struct_size = kMarkSize;
  (void)walr_check_device(&device);
}

void CallCheck::judge(std::string_view function, const Expectation& expected,
                      const std::vector<std::string_view>& names, WalrResult result) {
  ++calls_;
  const std::string_view text = walr_last_error();
  const bool failed = result != WALR_SUCCESS;
  std::string line = std::string(function) + ": " + walr_result_name(result);
  if (failed) line.append(", ").append(text);
  log_.push_back(std::move(line));
  if (!expected.allows(result)) fault("unexpected result");
  if (!failed) return;

  ++failures_;
  if (text.empty() || text.starts_with(kMark)) {
    fault("no text of the error");
  } else if (std::ranges::none_of(names, [&](std::string_view name) { return text.find(name) != text.npos; })) {
    fault("the text names no argument");
  }
}

std::string CallCheck::history() const {
  std::string text;
  for (const std::string& line : log_) text += "\n  " + line;
  return text;
}

}  // namespace walr::test
