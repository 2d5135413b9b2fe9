#pragma once

#include <stdexcept>

namespace walr {

/// Input that cannot be used. The message names the file, the fault and the remedy.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Output that cannot be written. The message names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace walr
