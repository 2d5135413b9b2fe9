#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace walr::test {

/// Exit code and output of a program.
struct ProcessResult {
  int exitCode = -1;  ///< -1 if a signal ended the program.
  std::string out;
  std::string err;
};

struct ProcessOptions {
  std::map<std::string, std::string> environment;  ///< Added to the environment of this process.
  std::optional<std::uint64_t> largestFileBytes;   ///< RLIMIT_FSIZE.
};

/// Run a program to its end.
ProcessResult runProcess(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

}  // namespace walr::test
