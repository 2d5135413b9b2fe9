#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace walr::test {

/// How a program ended and what it said.
struct ProcessResult {
  int exitCode = -1;  ///< -1 where a signal ended it.
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::map<std::string, std::string> environment;  ///< Set on top of the own one.
  std::optional<std::uint64_t> largestFileBytes;   ///< RLIMIT_FSIZE.
};

/// Run a program to its end.
ProcessResult runProcess(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

}  // namespace walr::test
