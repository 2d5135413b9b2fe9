#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace walr::test {

/// Exit code and output of a program.
struct ProcessResult {
  int exitCode = -1;  ///< -1 if a signal ended the program.
  std::string out;
  std::string err;
};

/// Exit codes that the programs promise (samples/README.md).
inline constexpr int kUsage = 2;
inline constexpr int kInput = 3;
inline constexpr int kDevice = 4;
inline constexpr int kOutput = 5;

struct ProcessOptions {
  std::map<std::string, std::string> environment;    ///< Added to the environment of this process.
  std::optional<std::uint64_t> largestFileBytes{};   ///< RLIMIT_FSIZE.
  std::optional<std::uint64_t> addressSpaceBytes{};  ///< RLIMIT_AS.
};

/// Run a program to its end.
ProcessResult runProcess(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

inline void expectSuccess(const ProcessResult& result) {
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
}
/// A program must have failed with a code, and its message must hold these parts.
inline void expectFailure(const ProcessResult& result, int code, std::initializer_list<std::string_view> parts) {
  EXPECT_EQ(result.exitCode, code) << result.err;
  fg::test::expectContains(result.err, parts);
}

}  // namespace walr::test
