#pragma once

#include <stdexcept>

namespace walr {

/// A command line that parses but is not valid. The message says what to write instead.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace walr
