#pragma once

#include <string>
#include <vector>

namespace walr {

/// How a program that was run ended.
struct ChildResult {
  int exitCode = -1;   ///< -1 where it could not be run, or a signal ended it.
  std::string output;  ///< What it printed, where that was asked for.
};

/// Where the output of a program goes.
enum class ChildOutput { Inherited, Captured };

/// Run a program to its end, with nothing to read.
/// @param arguments the program, looked for along PATH, and what it is given
ChildResult runChild(std::vector<std::string> arguments, ChildOutput output);

}  // namespace walr
