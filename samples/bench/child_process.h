#pragma once

#include <string>
#include <vector>

namespace walr {

/// Result of a child process.
struct ChildResult {
  int exitCode = -1;   ///< -1 if the program could not be run, or a signal ended it.
  std::string output;  ///< Its output, if captured.
};

/// What happens to the output of a child process.
enum class ChildOutput { Inherited, Captured };

/// Run a program with empty standard input, and wait for its end.
/// @param arguments  the program, which is searched along PATH, and its arguments
ChildResult runChild(std::vector<std::string> arguments, ChildOutput output);

}  // namespace walr
